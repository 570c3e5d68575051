// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/patch_inspector.h"

#include <QLabel>
#include <algorithm>
#include <utility>

#include "model/snapshot_values.h"
#include "patches/balance_view.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/fold.h"
#include "widgets/value_grid.h"

namespace transillum::viewer {

PatchInspector::PatchInspector(Focus& focus, Selection& selection, const ColorChoice& colors,
                               QWidget* parent)
    : QWidget(parent), selection_(selection), colors_(colors) {
  hint_ = note_label(tr("Click a patch in the scene or in the map."));
  make_sums();
  make_coefficients();
  values_ = new ValueGrid;
  id_ = values_->add_row(tr("Patch"), {});
  id_->setObjectName("patch_id");
  material_ = values_->add_row(tr("Material"), {});
  group_ = values_->add_row(tr("Group"), {});
  radiosity_ = add_quantity(Quantity::radiosity, "patch_radiosity");
  error_ = add_quantity(Quantity::error, "patch_error");
  irradiance_ = add_quantity(Quantity::irradiance, "patch_irradiance");
  exitance_ = add_quantity(Quantity::exitance, "patch_exitance");
  reflectance_ = add_quantity(Quantity::reflectance, "patch_reflectance");
  swatch_ = new QLabel;
  swatch_->setFixedHeight(10);
  swatch_->setToolTip(tr("Color of the patch in the scene view"));
  values_->add_wide(swatch_);
  area_ = values_->add_row(tr("Area"), tr("m²"));
  form_factor_sum_ = add_quantity(Quantity::form_factor_sum, "patch_form_factor_sum");
  sky_fraction_ = add_quantity(Quantity::sky_fraction, "patch_sky_fraction");
  center_ = values_->add_row(tr("Center"), tr("m"));
  normal_ = values_->add_row(tr("Normal"), {});
  face_ = values_->add_row(tr("Face"), {});
  balance_ = new BalanceView(focus, selection);
  why_ = new Fold(QStringLiteral("why_section"), tr("Why this number?"), balance_);

  auto* layout = make_column(this, {12, 8, 12, 10});
  layout->addWidget(hint_);
  layout->addWidget(why_);
  layout->addWidget(sums_);
  layout->addWidget(values_);
  layout->addWidget(coefficients_);
  layout->addStretch(1);
  connect(balance_, &BalanceView::panel_wanted, this, &PatchInspector::panel_wanted);
  connect(balance_, &BalanceView::table_wanted, this, &PatchInspector::table_wanted);
  connect(balance_, &BalanceView::directions_wanted, this, &PatchInspector::directions_wanted);
  connect(balance_, &BalanceView::form_factors_requested, &colors_,
          &ColorChoice::form_factors_requested);
  connect(why_->header(), &QAbstractButton::toggled, this, &PatchInspector::show_balance);
  connect(&selection_, &Selection::patches_changed, this, &PatchInspector::show_patch);
  connect(&colors_, &ColorChoice::changed, this, &PatchInspector::show_patch);
  show_patch();
}

QLabel* PatchInspector::add_quantity(Quantity quantity, const char* name) {
  const QuantityTraits& traits = traits_of(quantity);
  QString tip = tip_of(quantity);
  if (traits.is_light) {
    tip += QLatin1Char('\n') + tr("Red, green, blue");
  }
  QLabel* value =
      values_->add_row(QString::fromUtf8(traits.symbol), QString::fromUtf8(traits.unit), tip);
  value->setObjectName(QString::fromLatin1(name));
  return value;
}

void PatchInspector::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  show_patch();
}

void PatchInspector::make_sums() {
  sums_ = new ValueGrid;
  count_ = sums_->add_row(tr("Selected"), {}, tr("Number of selected patches"));
  count_->setObjectName("selected_count");
  const auto add = [this](const char* name, const QString& text, const QString& unit,
                          const QString& tip) {
    QLabel* value = sums_->add_row(text, unit, tip);
    value->setObjectName(QString::fromLatin1(name));
    return value;
  };
  total_area_ = add("selected_area", tr("Σ A"), tr("m²"), tr("Sum of the areas"));
  emitted_ = add("selected_emitted", tr("Σ A E"), tr("W"),
                 symbol_tip(tr("Power that the selected patches emit: red, green, blue"), "2"));
  leaving_ = add("selected_leaving", tr("Σ A B"), tr("W"),
                 symbol_tip(tr("Power that leaves the selected patches: red, green, blue"), "2"));
  received_ = add("selected_received", tr("Σ A H"), tr("W"),
                  symbol_tip(tr("Power that the selected patches receive: red, green, blue"), "2"));
  mean_ = add("selected_mean", tr("mean B"), tr("W/m²"),
              symbol_tip(tr("Mean radiosity by area: red, green, blue"), "2"));
}

void PatchInspector::make_coefficients() {
  coefficients_ = new ValueGrid;
  auto* title = note_label(tr("B(x) = b₀ + b₁ φ₁(x) + b₂ φ₂(x)"), {0, 8, 0, 0});
  title->setToolTip(symbol_tip(
      tr("B is a linear function of the point x of the patch. φ₁ grows along the longest edge, φ₂ "
         "across it;\nboth are 0 at the center, and the mean of their squares over the patch is 1"),
      "6.12"));
  coefficients_->add_wide(title);
  const auto add = [this](const char* name, const QString& symbol, const QString& tip) {
    QLabel* value = coefficients_->add_row(symbol, tr("W/m²"),
                                           symbol_tip(tip, "6.12") + '\n' + tr("Red, green, blue"));
    value->setObjectName(QString::fromLatin1(name));
    return value;
  };
  mean_b_ = add("coefficient_0", tr("b₀"), tr("Mean of B over the patch, also B at its center"));
  first_b_ = add("coefficient_1", tr("b₁"),
                 tr("Difference of B from its mean along the longest edge (root mean square);\n"
                    "positive if B grows in the direction of φ₁"));
  second_b_ = add("coefficient_2", tr("b₂"),
                  tr("Difference of B from its mean across the longest edge (root mean square);\n"
                     "positive if B grows in the direction of φ₂"));
  const auto add_direction = [this](const QString& symbol) {
    return coefficients_->add_row(symbol, {},
                                  tr("The direction in which the function grows, a unit vector"));
  };
  first_direction_ = add_direction(tr("φ₁ along"));
  second_direction_ = add_direction(tr("φ₂ along"));
  lowest_ =
      add("corner_lowest", tr("least"),
          tr("Least B of a corner, in each channel. B can be below 0 where a patch lies across "
             "the edge\nof a shadow; results keep such values, pictures show them as 0"));
  highest_ = add("corner_highest", tr("largest"), tr("Largest B of a corner, in each channel"));
}

void PatchInspector::show_coefficients(PatchId patch) {
  const bool linear = !snapshot_->linear_terms.empty();
  coefficients_->setVisible(linear && selection_.patches().size() == 1);
  if (!linear) {
    return;
  }
  const LinearTerm& term = at(snapshot_->linear_terms, patch);
  const Scene& scene = *snapshot_->loaded->scene;
  Rgb lowest = at(snapshot_->radiosity, patch), highest = lowest;
  for (const PointId corner : scene.outline(patch)) {
    const Rgb b = radiosity_at(*snapshot_, patch, scene.point(corner));
    lowest = {std::min(lowest.r, b.r), std::min(lowest.g, b.g), std::min(lowest.b, b.b)};
    highest = {std::max(highest.r, b.r), std::max(highest.g, b.g), std::max(highest.b, b.b)};
  }
  mean_b_->setText(rgb_text(at(snapshot_->radiosity, patch)));
  first_b_->setText(rgb_text(term.first));
  second_b_->setText(rgb_text(term.second));
  lowest_->setText(rgb_text(lowest));
  highest_->setText(rgb_text(highest));
  const LinearBasis& basis = at(*snapshot_->bases, patch);
  first_direction_->setText(vector_text(normalized(basis.gradient[0])));
  second_direction_->setText(vector_text(normalized(basis.gradient[1])));
}

void PatchInspector::show_sums() {
  const std::vector<PatchId>& patches = selection_.patches();
  const bool several =
      snapshot_ && patches.size() > 1 && patches.back() < snapshot_->loaded->scene->patch_count();
  sums_->setVisible(several);
  if (!several) {
    return;
  }
  double area = 0;
  Rgb emitted, leaving, received;
  const PatchValues irradiance = values_of(Quantity::irradiance, *snapshot_, no_patch, nullptr);
  for (const PatchId i : patches) {
    const double a = snapshot_->loaded->scene->patch(i).area;
    area += a;
    emitted += a * material_of(*snapshot_, i).exitance;
    leaving += a * at(snapshot_->radiosity, i);
    received += a * (irradiance.values.empty() ? Rgb{} : at(irradiance.values, i));
  }
  count_->setText(tr("%1 patches, i = %2")
                      .arg(count_text(static_cast<std::int64_t>(patches.size())))
                      .arg(selection_.patch()));
  total_area_->setText(number_text(area));
  emitted_->setText(rgb_text(emitted));
  leaving_->setText(rgb_text(leaving));
  received_->setText(irradiance.values.empty() ? QStringLiteral("–") : rgb_text(received));
  mean_->setText(rgb_text((1 / area) * leaving));
}

void PatchInspector::show_balance() {
  const bool one = snapshot_ && selection_.patches().size() == 1;
  why_->setVisible(one);
  balance_->show_balance(snapshot_, one && why_->is_open() ? selection_.patch() : no_patch);
}

void PatchInspector::show_patch() {
  show_sums();
  show_balance();
  const PatchId patch = selection_.patch();
  const bool any = snapshot_ && patch >= 0 && patch < snapshot_->loaded->scene->patch_count();
  hint_->setVisible(!any);
  values_->setVisible(any && selection_.patches().size() == 1);
  if (!any) {
    coefficients_->hide();
    return;
  }
  show_coefficients(patch);
  const Scene& scene = *snapshot_->loaded->scene;
  const Patch& p = scene.patch(patch);
  // Written as in files, without separators of thousands.
  id_->setText(QString::number(patch));
  face_->setText(QString::number(p.face));
  material_->setText(QString::fromStdString(scene.material(patch).name));
  group_->setText(p.group == no_group ? QStringLiteral("–")
                                      : QString::fromStdString(at(scene.groups(), p.group)));
  area_->setText(number_text(p.area));
  center_->setText(vector_text(p.center));
  normal_->setText(vector_text(p.normal));
  exitance_->setText(rgb_text(material_of(*snapshot_, patch).exitance));
  reflectance_->setText(rgb_text(material_of(*snapshot_, patch).reflectance));
  radiosity_->setText(rgb_text(at(snapshot_->radiosity, patch)));
  for (const auto& [quantity, label] :
       {std::pair{Quantity::error, error_}, {Quantity::irradiance, irradiance_}}) {
    const PatchValues found = values_of(quantity, *snapshot_, no_patch, nullptr);
    label->setText(found.values.empty() ? QStringLiteral("–") : rgb_text(at(found.values, patch)));
  }
  form_factor_sum_->setText(QString::number(at(snapshot_->form_factor_sums, patch), 'f', 6));
  sky_fraction_->setText(snapshot_->sky_fractions.empty()
                             ? QStringLiteral("–")
                             : QString::number(at(snapshot_->sky_fractions, patch), 'f', 6));
  const Color8 c = at(colors_.patch_colors(), patch);
  swatch_->setStyleSheet(
      QStringLiteral("background: %1; border: 1px solid #9aa2ac; border-radius: 2px;")
          .arg(QColor(c[0], c[1], c[2]).name()));
}

}  // namespace transillum::viewer

// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Solve settings": one control per option of the next solve. Names and tool tips come
// from the library's list of settings.
#include "solve/settings_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QDoubleValidator>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QRegularExpression>
#include <QRegularExpressionValidator>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QStackedWidget>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "model/run_options.h"
#include "session/total_plan.h"
#include "solve/refine_controls.h"
#include "solve/round_panel.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/engine_text.h"
#include "widgets/scrolling.h"

namespace transillum::viewer {

namespace {

/// The choices of an enumeration, in its order.
template <class Value>
void add_choices(QComboBox& box) {
  for (const std::string& label : choices_of<Value>().labels) {
    box.addItem(QString::fromStdString(label));
  }
}

// The accuracy is about the sum of all errors: data of its entry, beside the values of AccuracyOf.
constexpr int in_all = -1;

// The slider's position is the square root of the sky's fraction of this.
constexpr int sky_steps = 200;
constexpr double sky_of_slider = 100;  // W/m²

struct Axis {
  const char* name;
  Vec3 direction;
};
constexpr Axis axes[] = {{"+z", {0, 0, 1}},  {"+y", {0, 1, 0}},  {"+x", {1, 0, 0}},
                         {"−z", {0, 0, -1}}, {"−y", {0, -1, 0}}, {"−x", {-1, 0, 0}}};

bool same(const SceneOptions& a, const SceneOptions& b) {
  return a.two_sided == b.two_sided && a.max_patch_area == b.max_patch_area;
}

// Rich text, so that Qt wraps long lines.
QString tip(const char* setting) {
  const QString sentence = capitalized(QString::fromStdString(option(setting).help));
  return QStringLiteral("<span>%1</span>").arg(sentence.toHtmlEscaped());
}

// The shortest digits that read back bit for bit.
QString exact_text(double value) {
  return QString::number(value, 'g', QLocale::FloatingPointShortest);
}

}  // namespace

SettingsPanel::SettingsPanel(QWidget* parent) : QWidget(parent) {
  auto* form = form_ = new QFormLayout;
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(10);
  form->setVerticalSpacing(6);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  add_direction_rows(*form);
  add_engine_rows(*form);
  add_estimator_rows(*form);
  add_stop_row(*form);
  add_sky_rows(*form);
  connect_solve_rows();
  add_scene_rows(*form);
  refine_ = new RefineControls;
  form->addRow(tr("Refine by"), refine_);
  connect(refine_, &RefineControls::changed, this, &SettingsPanel::show_state);
  restart_ = named("restart", new QPushButton(tr("Solve again")));
  auto* layout = make_column(this, {12, 10, 12, 10}, 10);
  layout->addLayout(form);
  layout->addWidget(restart_);
  rounds_ = new RoundPanel;
  layout->addWidget(rounds_);
  layout->addStretch(1);
  connect(restart_, &QPushButton::clicked, this, &SettingsPanel::restart_clicked);
  set_options({}, {});
}

void SettingsPanel::add_direction_rows(QFormLayout& form) {
  directions_ = named("directions", new QSpinBox, tip("directions"));
  directions_->setRange(1, 1 << 24);
  directions_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  directions_->setGroupSeparatorShown(false);
  sampling_ = named("sampling", new QComboBox);
  add_choices<Sampling>(*sampling_);
  sampling_->setToolTip(tip("sampling"));
  seed_ = named("seed", new QLineEdit, tip("seed"));
  seed_->setValidator(
      new QRegularExpressionValidator(QRegularExpression(QStringLiteral("[0-9]{1,20}")), seed_));
  form.addRow(tr("Directions M"), directions_);
  add_accuracy_row(form);
  form.addRow(tr("Sampling"), sampling_);
  form.addRow(tr("Seed"), seed_);
}

void SettingsPanel::add_accuracy_row(QFormLayout& form) {
  accuracy_ = named("accuracy", new QLineEdit);
  auto* percent = new QDoubleValidator(0, 99, 6, accuracy_);
  percent->setLocale(QLocale::c());
  accuracy_->setValidator(percent);
  accuracy_->setPlaceholderText(tr("None"));
  accuracy_->setMinimumWidth(60);
  accuracy_->setToolTip(tip("accuracy"));
  accuracy_of_ = named("accuracy_of", new QComboBox);
  for (const auto& [of, text] : {std::pair{AccuracyOf::surfaces, tr("% worst")},
                                 {AccuracyOf::irradiance, tr("% irradiance")},
                                 {AccuracyOf::rms, tr("% RMS")},
                                 {AccuracyOf::max, tr("% largest")},
                                 {AccuracyOf::patch, tr("% patch")},
                                 {AccuracyOf::mean, tr("% mean")}}) {
    accuracy_of_->addItem(text, static_cast<int>(of));
  }
  accuracy_of_->insertItem(1, tr("% in all"), in_all);
  accuracy_of_->setItemData(1, tip("total"), Qt::ToolTipRole);
  accuracy_of_->setToolTip(tip("accuracy-of"));
  accuracy_of_->setMinimumWidth(60);
  auto* row = make_row({}, 6);
  row->addWidget(accuracy_, 1);
  row->addWidget(accuracy_of_, 1);
  form.addRow(tr("Accuracy"), row);
}

void SettingsPanel::add_engine_rows(QFormLayout& form) {
  engine_ = named("engine", new QComboBox);
  add_engines(*engine_, false);
  resolution_ = named("resolution", new QSpinBox);
  resolution_->setRange(0, EngineOptions::largest_resolution);
  resolution_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  resolution_->setSuffix(tr(" px"));
  order_ = named("painters_order", new QComboBox);
  add_choices<PaintersOrder>(*order_);
  order_->setToolTip(
      tr("Order of painting\nBSP tree: splits polygons that overlap cyclically, so an order always "
         "exists\nNewell's tests: do not split, and fail on cyclic overlap"));
  form.addRow(tr("Engine"), engine_);
  resolution_label_ = new QLabel(tr("Resolution"), this);
  order_label_ = new QLabel(tr("Painter's order"), this);
  for (QWidget* widget : {static_cast<QWidget*>(resolution_), static_cast<QWidget*>(order_)}) {
    widget->setParent(this);
  }
}

void SettingsPanel::add_estimator_rows(QFormLayout& form) {
  pass_serves_ = named("pass_serves", new QComboBox, tip("one-way"));
  pass_serves_->addItems({tr("serves ω and −ω"), tr("serves ω only (paper)")});
  normalize_ = new QComboBox;
  add_choices<Normalization>(*normalize_);
  normalize_->setToolTip(
      tr("Rows: divide each row by the patch's quadrature of the cosine\n"
         "Symmetric: scale rows and columns alike, which preserves reciprocity"));
  scheme_ = new QComboBox;
  add_choices<Scheme>(*scheme_);
  scheme_->setToolTip(
      tr("Fixed: the same directions in every iteration\n"
         "Growing: twice as many directions in each iteration, up to M\n"
         "Semi-iterative: M new directions in each iteration, and the mean over iterations\n"
         "Conjugate gradients: one set of passes, then the linear system is solved"));
  replicas_ = named("replicas", new QSpinBox, tip("replicas"));
  replicas_->setRange(1, 64);
  replicas_->setSpecialValueText(tr("None"));
  basis_ = named("basis", new QComboBox);
  add_choices<Basis>(*basis_);
  basis_->setToolTip(tr(
      "Constant: one value of B per patch\n"
      "Linear: a linear function on each patch, with engines Fast, Local map and Exact numbers;\n"
      "a pass takes about one and a half times as long, form factors take nine times the memory"));
  basis_note_ = named("basis_note", note_label());
  basis_note_->hide();
  auto* basis_column = make_column({}, 2);
  basis_column->addWidget(basis_);
  basis_column->addWidget(basis_note_);
  form.addRow(tr("B on a patch"), basis_column);
  add_glossy_row(form);
  form.addRow(tr("Each pass"), pass_serves_);
  form.addRow(tr("Normalize"), normalize_);
  form.addRow(tr("Scheme"), scheme_);
  form.addRow(tr("Replicas"), replicas_);
}

void SettingsPanel::add_stop_row(QFormLayout& form) {
  stop_at_ = new QComboBox;
  stop_at_->addItems({tr("Tolerance"), tr("Iterations")});
  stop_at_->setMinimumWidth(60);
  tolerance_ = new QLineEdit;
  auto* positive = new QDoubleValidator(0, 1, 15, tolerance_);
  positive->setLocale(QLocale::c());
  tolerance_->setValidator(positive);
  tolerance_->setMinimumWidth(60);
  tolerance_->setToolTip(tip("tolerance"));
  iterations_ = new QSpinBox;
  iterations_->setRange(1, 1'000'000);
  iterations_->setMinimumWidth(60);
  stop_value_ = new QStackedWidget;
  stop_value_->addWidget(tolerance_);
  stop_value_->addWidget(iterations_);
  auto* stop_row = make_row({}, 6);
  stop_row->addWidget(stop_at_, 3);
  stop_row->addWidget(stop_value_, 2);
  form.addRow(tr("Stop at"), stop_row);
}

void SettingsPanel::add_sky_rows(QFormLayout& form) {
  sky_slider_ = named("sky_slider", new QSlider(Qt::Horizontal));
  sky_slider_->setRange(0, sky_steps);
  sky_slider_->setMinimumWidth(60);
  sky_value_ = named("sky", new QDoubleSpinBox);
  sky_value_->setRange(0, 1e6);
  sky_value_->setDecimals(3);
  sky_value_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  sky_value_->setMinimumWidth(60);
  sky_value_->setSpecialValueText(tr("None"));
  sky_value_->setKeyboardTracking(false);
  sky_value_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  auto* row = make_row({}, 6);
  row->addWidget(sky_slider_, 3);
  row->addWidget(sky_value_, 3);
  auto* column = make_column({}, 2);
  column->addLayout(row);
  sky_note_ = named("sky_note", new QLabel);
  sky_note_->setForegroundRole(QPalette::PlaceholderText);
  sky_note_->hide();
  column->addWidget(sky_note_);  // one line: the layout of a form does not count further lines
  form.addRow(tr("Sky, W/m²"), column);
  sky_model_ = named("sky_model", new QComboBox);
  // In the order of SkyModel.
  add_choices<SkyModel>(*sky_model_);
  sky_model_->setToolTip(tr(
      "Uniform: the same radiance from all directions, also from below\n"
      "CIE overcast: three times as bright at the zenith as at the horizon, nothing from below"));
  form.addRow(tr("Sky model"), sky_model_);
  sky_up_ = named("sky_up", new QComboBox);
  for (const Axis& axis : axes) {
    sky_up_->addItem(QString::fromUtf8(axis.name));
  }
  sky_up_->addItem(QString());  // another direction, of a session or a command line
  sky_up_->setToolTip(tr("The direction of the zenith"));
  sky_up_label_ = new QLabel(tr("Zenith"));
  form.addRow(sky_up_label_, sky_up_);
  connect(sky_slider_, &QSlider::valueChanged, this, [this](int step) {
    const double fraction = 1.0 * step / sky_steps;
    sky_value_->setValue(sky_of_slider * fraction * fraction);
  });
  connect(sky_value_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double value) {
    const QSignalBlocker quiet(sky_slider_);
    sky_slider_->setValue(
        static_cast<int>(std::lround(sky_steps * std::sqrt(std::min(1.0, value / sky_of_slider)))));
    show_state();
  });
}

Sky SettingsPanel::sky() const {
  if (!(sky_value_->value() > 0) || !takes_directions(engine_of(*engine_))) {
    return {};
  }
  Sky sky = base_.sky;  // with all its digits, unless changed
  if (sky_value_->value() !=
      sky_value_->valueFromText(sky_value_->textFromValue(max_abs(base_.sky.exitance)))) {
    sky.exitance = sky_value_->value() * sky_color_;
  }
  sky.model = static_cast<SkyModel>(sky_model_->currentIndex());
  const int axis = sky_up_->currentIndex();
  if (sky.model == SkyModel::uniform) {
    sky.up = Sky().up;  // not read
  } else if (axis >= 0 && axis < static_cast<int>(std::size(axes))) {
    sky.up = axes[axis].direction;
  }
  return sky;
}

void SettingsPanel::set_sky(const Sky& sky) {
  const double largest = max_abs(sky.exitance);
  sky_color_ = largest > 0 ? (1 / largest) * sky.exitance : Rgb{1, 1, 1};
  sky_value_->setValue(largest);
  sky_model_->setCurrentIndex(static_cast<int>(sky.model));
  if (sky.is_set() && sky.model != SkyModel::uniform) {
    choose_up(sky.up);
  }
}

void SettingsPanel::choose_up(const Vec3& up) {
  int index = 0;
  while (index < static_cast<int>(std::size(axes)) && !(axes[index].direction == up)) {
    ++index;
  }
  if (index == static_cast<int>(std::size(axes))) {
    sky_up_->setItemText(index, vector_text(up));
    base_.sky.up = up;
  }
  sky_up_->setCurrentIndex(index);
}

void SettingsPanel::set_scene_up(const Vec3& up) {
  if (!sky().is_set()) {
    choose_up(up);
  }
}

void SettingsPanel::show_escape(std::optional<double> fraction) {
  constexpr double rounding = 1e-9;
  closed_ = fraction && *fraction < rounding;
  show_sky_state();
}

bool SettingsPanel::may_have_sky() const { return sky_value_->isEnabledTo(this); }

void SettingsPanel::ask_for_sky() {
  scroll_to(sky_value_);
  sky_value_->setFocus();
  sky_value_->selectAll();
}

void SettingsPanel::show_sky_state() {
  const bool takes = takes_directions(engine_of(*engine_));
  const QString note = !takes    ? tr("Not with this engine")
                       : closed_ ? tr("The scene is closed")
                                 : QString();
  sky_note_->setText(note);
  sky_note_->setVisible(!note.isEmpty());
  const bool enabled = note.isEmpty();
  for (QWidget* widget : {static_cast<QWidget*>(sky_slider_), static_cast<QWidget*>(sky_value_)}) {
    widget->setEnabled(enabled);
    widget->setToolTip(
        tr("Irradiance of an unobstructed patch that faces the zenith; the sky lights "
           "an open scene along directions without a patch. 0 switches the sky off"));
  }
  const bool any = enabled && sky_value_->value() > 0;
  sky_model_->setEnabled(any);
  sky_up_->setEnabled(any && sky_model_->currentIndex() != 0);
  sky_up_label_->setEnabled(sky_up_->isEnabled());
}

void SettingsPanel::connect_solve_rows() {
  connect(glossy_, &QCheckBox::toggled, this, &SettingsPanel::show_state);
  for (QComboBox* box : {sampling_, engine_, order_, pass_serves_, normalize_, scheme_, basis_,
                         stop_at_, accuracy_of_, sky_model_, sky_up_}) {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
    connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, &SettingsPanel::show_state);
  }
  connect(pass_serves_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
    const bool two_way = index == 0;
    if (sampling_->currentIndex() == static_cast<int>(default_sampling(!two_way))) {
      sampling_->setCurrentIndex(static_cast<int>(default_sampling(two_way)));
    }
  });
  for (QSpinBox* box : {directions_, resolution_, replicas_, iterations_}) {
    connect(box, qOverload<int>(&QSpinBox::valueChanged), this, &SettingsPanel::show_state);
  }
  for (QLineEdit* line : {seed_, tolerance_, accuracy_}) {
    connect(line, &QLineEdit::textChanged, this, &SettingsPanel::show_state);
  }
}

void SettingsPanel::add_scene_rows(QFormLayout& form) {
  max_patch_area_ = named("max_patch_area", new QLineEdit);
  auto* area = new QDoubleValidator(max_patch_area_);
  area->setBottom(0);
  area->setLocale(QLocale::c());
  max_patch_area_->setValidator(area);
  max_patch_area_->setPlaceholderText(tr("Faces not divided"));
  max_patch_area_->setToolTip(tip("max-patch-area"));
  two_sided_ = named("two_sided", new QCheckBox(tr("Two-sided faces")), tip("two-sided"));
  auto* area_column = make_column({}, 2);
  area_column->addWidget(max_patch_area_);
  form.addRow(tr("Patch area, m²"), area_column);
  forecast_ = named("patch_forecast", note_label(),
                    tr("Number of patches for this area, and approximate memory for a solve"));
  forecast_->hide();
  area_column->addWidget(forecast_);
  form.addRow(QString(), two_sided_);
  for (const auto& show : {&SettingsPanel::show_state, &SettingsPanel::want_forecast}) {
    connect(max_patch_area_, &QLineEdit::textChanged, this, show);
    connect(two_sided_, &QCheckBox::toggled, this, show);
  }
}

RefineChoice SettingsPanel::refinement() const {
  RefineChoice refine = refine_->choice();
  if (fixed_ || total()) {
    refine.by.reset();
  }
  return refine;
}

bool SettingsPanel::total() const {
  return !fixed_ && accuracy_of_->currentData().toInt() == in_all && goal().accuracy > 0;
}

AccuracyGoal SettingsPanel::goal() const {
  AccuracyGoal goal = base_.goal;
  if (accuracy_->text() != exact_text(100 * goal.accuracy)) {
    goal.accuracy = QLocale::c().toDouble(accuracy_->text()) / 100;
  }
  const int of = accuracy_of_->currentData().toInt();
  goal.of = of == in_all ? AccuracyOf::surfaces : static_cast<AccuracyOf>(of);
  return goal;
}

SolveOptions SettingsPanel::solve_options() const {
  SolveOptions options = base_;
  options.goal = goal();
  options.basis = static_cast<Basis>(basis_->currentIndex());
  options.glossy = glossy_->isChecked();
  options.directions = directions_->value();
  bool number = false;
  if (const qulonglong seed = seed_->text().toULongLong(&number); number) {
    options.seed = seed;
  }
  options.engine = engine_of(*engine_);
  options.engine_options.resolution = resolution_->value();
  options.engine_options.order = static_cast<PaintersOrder>(order_->currentIndex());
  options.two_way = pass_serves_->currentIndex() == 0;
  options.sampling = static_cast<Sampling>(sampling_->currentIndex());
  options.normalize = static_cast<Normalization>(normalize_->currentIndex());
  options.scheme = static_cast<Scheme>(scheme_->currentIndex());
  options.replicas = options.goal.is_set() ? 1 : replicas_->value();
  options.iterations = stop_at_->currentIndex() == 1 ? iterations_->value() : 0;
  const double tolerance = QLocale::c().toDouble(tolerance_->text(), &number);
  if (number && tolerance > 0) {
    options.tolerance = tolerance;
  }
  options.sky = sky();
  RunOptions run{.solve = options};
  set_dependent_defaults(run, {"accuracy"});
  return run.solve;
}

SceneOptions SettingsPanel::scene_options() const {
  // No number, as in an empty field, reads as 0: faces are not divided.
  return {two_sided_->isChecked(), QLocale::c().toDouble(max_patch_area_->text())};
}

void SettingsPanel::set_options(const SolveOptions& solve, const SceneOptions& scene) {
  base_ = solve;
  directions_->setValue(solve.directions);
  accuracy_->setText(solve.goal.accuracy > 0 ? exact_text(100 * solve.goal.accuracy) : QString());
  const auto item_of = [this](AccuracyOf of) {
    return accuracy_of_->findData(static_cast<int>(of));
  };
  accuracy_of_->setItemText(item_of(AccuracyOf::patch), tr("% patch %1").arg(solve.goal.patch));
  if (solve.goal.of == AccuracyOf::groups && item_of(AccuracyOf::groups) < 0) {
    accuracy_of_->addItem(tr("% groups named"), static_cast<int>(AccuracyOf::groups));
  }
  if (!(accuracy_of_->currentData().toInt() == in_all && solve.goal.of == AccuracyOf::surfaces)) {
    accuracy_of_->setCurrentIndex(item_of(solve.goal.of));
  }
  seed_->setText(QString::number(solve.seed));
  choose_engine(*engine_, solve.engine);
  resolution_->setValue(solve.engine_options.resolution);
  order_->setCurrentIndex(static_cast<int>(solve.engine_options.order));
  pass_serves_->setCurrentIndex(solve.two_way ? 0 : 1);
  // After `pass_serves_`, which may change it.
  sampling_->setCurrentIndex(static_cast<int>(solve.used_sampling()));
  normalize_->setCurrentIndex(static_cast<int>(solve.normalize));
  scheme_->setCurrentIndex(static_cast<int>(solve.scheme));
  basis_->setCurrentIndex(static_cast<int>(solve.basis));
  glossy_->setChecked(solve.glossy);
  replicas_->setValue(solve.replicas);
  stop_at_->setCurrentIndex(solve.iterations > 0 ? 1 : 0);
  iterations_->setValue(std::max(solve.iterations, 1));
  tolerance_->setText(exact_text(solve.tolerance));
  set_sky(solve.sky);
  two_sided_->setChecked(scene.two_sided);
  max_patch_area_->setText(scene.max_patch_area > 0 ? exact_text(scene.max_patch_area) : QString());
  show_state();
}

void SettingsPanel::set_options(const RunOptions& options) {
  RefineChoice refine = options.refine;
  if (options.total && refine.patches == 0) {
    refine.patches = static_cast<int>(TotalGoal().patches);
  }
  refine_->set_choice(refine);
  accuracy_of_->setCurrentIndex(options.total ? accuracy_of_->findData(in_all) : 0);
  set_options(options.solve, options.scene);
}

void SettingsPanel::set_in_effect(const SolveOptions& solve, const SceneOptions& scene,
                                  const RefineChoice& refine, bool total) {
  solve_in_effect_ = solve;
  scene_in_effect_ = scene;
  refine_in_effect_ = refine;
  total_in_effect_ = total;
  if (same(scene_options(), scene)) {
    forecast_->hide();
  }
  show_state();
}

bool SettingsPanel::differ_from_effect() const {
  const auto limit = [](const RefineChoice& refine) {
    return refine.patches > 0 ? refine.patches : TotalGoal().patches;
  };
  return !is_run_of(solve_in_effect_, solve_options()) || total() != total_in_effect_ ||
         (total() && limit(refinement()) != limit(refine_in_effect_)) ||
         !same(scene_options(), scene_in_effect_) || !(refinement() == refine_in_effect_);
}

void SettingsPanel::set_restart_enabled(bool enabled) {
  enabled_ = enabled;
  show_state();
}

void SettingsPanel::set_scene_fixed(bool fixed) {
  fixed_ = fixed;
  for (QWidget* widget :
       {static_cast<QWidget*>(max_patch_area_), static_cast<QWidget*>(two_sided_)}) {
    widget->setEnabled(!fixed);
  }
  const QString why = tr("Given by the result file");
  max_patch_area_->setToolTip(fixed ? why : tip("max-patch-area"));
  two_sided_->setToolTip(fixed ? why : tip("two-sided"));
  show_state();
}

void SettingsPanel::want_forecast() {
  forecast_->hide();
  if (enabled_ && !same(scene_options(), scene_in_effect_)) {
    emit forecast_wanted(scene_options());
  }
}

void SettingsPanel::show_forecast(const SceneOptions& options, const QString& text) {
  if (same(options, scene_options())) {
    forecast_->setText(text);
    forecast_->setVisible(!text.isEmpty() && !same(options, scene_in_effect_));
  }
}

void SettingsPanel::show_state() {
  if (!restart_) {
    return;  // the constructor has not made all controls yet
  }
  const auto has_effect = [run = options()](const char* setting) {
    return why_unused(setting, {run}).empty();
  };
  seed_->setEnabled(has_effect("seed"));
  stop_value_->setCurrentIndex(stop_at_->currentIndex());
  const bool chosen = goal().is_set();
  for (QWidget* widget : {static_cast<QWidget*>(directions_), static_cast<QWidget*>(replicas_)}) {
    widget->setEnabled(!chosen);
  }
  directions_->setToolTip(chosen ? tr("Chosen to reach the accuracy") : tip("directions"));
  replicas_->setToolTip(chosen ? tr("Chosen to reach the accuracy") : tip("replicas"));
  const Engine engine = engine_of(*engine_);
  engine_->setToolTip(engine_sentence(engine));
  show_sky_state();
  show_basis_state();
  refine_->set_available(!fixed_, total());
  show_glossy_state();
  show_row(order_label_, order_, has_effect("order"));
  show_row(resolution_label_, resolution_, has_effect("resolution"));
  const bool rays = traits_of(engine).error == EngineTraits::Error::statistical;
  resolution_->setSpecialValueText(
      rays ? tr("%1 rays per patch").arg(solve_in_effect_.engine_options.lines_per_patch)
           : tr("Default: %1 px").arg(EngineOptions::default_resolution));
  resolution_->setToolTip(
      rays ? tr("Pixels along the longer side of the projected scene, one ray through each;\n"
                "the smallest value sets a number of rays per patch instead")
           : tr("Pixels along the longer side of the projected scene"));
  const bool differs = enabled_ && differ_from_effect();
  restart_->setEnabled(enabled_);
  restart_->setText(differs ? tr("Solve again with these") : tr("Solve again"));
  restart_->setDefault(differs);
  QFont font = restart_->font();
  font.setBold(differs);
  restart_->setFont(font);
}

}  // namespace transillum::viewer

// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Solve settings": quality, patches and the button on top, and the other options of the
// next solve in sections below. Names and tool tips come from the library's list of settings.
#include "solve/settings_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QDoubleValidator>
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

#include "session/total_plan.h"
#include "solve/quality_controls.h"
#include "solve/refine_controls.h"
#include "solve/round_panel.h"
#include "solve/setting_tips.h"
#include "solve/sun_controls.h"
#include "state/camera_views.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/count_box.h"
#include "widgets/engine_text.h"
#include "widgets/fold.h"
#include "widgets/scrolling.h"
#include "widgets/setting_rows.h"

namespace transillum::viewer {

namespace {

/// A box with the choices of an enumeration, in its order.
template <class Value>
QComboBox* choice_box(const QString& name, const QString& tip) {
  auto* box = named(name, new QComboBox, tip);
  for (const std::string& label : choices_of<Value>().labels) {
    box->addItem(QString::fromStdString(label));
  }
  return box;
}

constexpr int most_patches = 50'000'000;

// The slider's position is the square root of the sky's fraction of this.
constexpr int sky_steps = 200;
constexpr double sky_of_slider = 100;  // W/m²

bool same(const SceneOptions& a, const SceneOptions& b) {
  return a.two_sided == b.two_sided && a.max_patch_area == b.max_patch_area;
}

QDoubleValidator* number_validator(QObject* parent, double low, double high, int decimals) {
  auto* validator = new QDoubleValidator(low, high, decimals, parent);
  validator->setLocale(QLocale::c());
  return validator;
}

/// A field and a note below it, in one row.
QWidget* with_note(QWidget* field, QLabel* note) {
  auto* column = new QWidget;
  auto* layout = make_column(column, {}, 2);
  layout->addWidget(field);
  layout->addWidget(note);
  note->hide();
  return column;
}

}  // namespace

SettingsPanel::SettingsPanel(QWidget* parent) : QWidget(parent) {
  make_column(this, {12, 10, 0, 0}, 8);
  add_top();
  sections_ = new QWidget;
  make_column(sections_, {0, 0, 12, 10}, 0);
  add_method();
  refine_ = new RefineControls;
  add_section(refine_section_ = new Fold("refine_section", tr("Refine"), refine_));
  add_limits();
  add_sky();  // the last, as it is hidden while no light escapes from the scene
  rounds_ = new RoundPanel;
  sections_->layout()->addWidget(rounds_);
  static_cast<QBoxLayout*>(sections_->layout())->addStretch(1);
  QWidget* scrolling = scrollable(sections_);
  scrolling->setMinimumHeight(1);  // a low dock shows the button, and one scroll bar
  layout()->addWidget(scrolling);
  connect_changes();
  made_ = true;
  set_options({}, {});
}

void SettingsPanel::add_section(Fold* fold) { sections_->layout()->addWidget(fold); }

void SettingsPanel::add_top() {
  quality_ = new QualityControls;
  patches_ = named("patches_wanted", new CountBox,
                   tr("About how many patches the faces are divided into; the lowest value does "
                      "not divide them"));
  patches_->setRange(0, most_patches);
  patches_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  patches_->setSpecialValueText(tr("faces as in the file"));
  patches_->setPrefix(tr("about "));
  patches_->setKeyboardTracking(false);
  patches_row_ = new QWidget;
  auto* patches = make_column(patches_row_, {}, 3);
  auto* patches_label = new QLabel(tr("Patches"));
  patches_label->setToolTip(patches_->toolTip());
  patches_label->setBuddy(patches_);
  patches->addWidget(patches_label);
  patches->addWidget(patches_);
  cost_ = named("patch_forecast", note_label(),
                tr("Patches, time and memory of the next solve, without kept form factors; the "
                   "time is known once passes of the same engine have been made"));
  restart_ =
      named("restart", new QPushButton(tr("Solve")), tr("Solve the scene with these settings"));
  restart_->setProperty("primary", true);
  how_wrong_ = named("how_wrong", new QPushButton(tr("How wrong is it?")),
                     tr("Measure the error of each surface, by directions, patches, iterations and "
                        "method: Errors, in the panel Surfaces"));
  auto* quality_label = new QLabel(tr("Quality"));
  quality_label->setToolTip(tr(
      "How many passes are made, each along one direction or two opposite ones: by number, or by "
      "the error that is allowed"));
  auto* top = make_column({0, 0, 12, 0}, 3);
  top->addWidget(quality_label);
  top->addWidget(quality_);
  top->addSpacing(5);
  top->addWidget(patches_row_);
  top->addWidget(cost_);
  top->addSpacing(5);
  top->addWidget(restart_);
  top->addSpacing(2);
  top->addWidget(how_wrong_);
  static_cast<QBoxLayout*>(layout())->addLayout(top);
}

void SettingsPanel::add_method() {
  auto* rows = new SettingRows;
  add_engine_rows(*rows);
  add_estimator_rows(*rows);
  add_direction_rows(*rows);
  rows->add(tr("Accuracy of"), quality_->accuracy_of(), setting_tip("accuracy-of"));
  two_sided_ = named("two_sided", new QCheckBox(tr("Two-sided faces")), setting_tip("two-sided"));
  rows->add(two_sided_);
  add_section(method_ = new Fold("method_section", tr("Method"), rows));
}

void SettingsPanel::add_engine_rows(SettingRows& rows) {
  engine_ = named("engine", new QComboBox);
  add_engines(*engine_, false);
  resolution_ = named("resolution", new CountBox);
  resolution_->setRange(0, EngineOptions::largest_resolution);
  resolution_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  resolution_->setSuffix(tr(" px"));
  order_ = choice_box<PaintersOrder>(
      "painters_order",
      tr("Order of painting\nBSP tree: splits polygons that overlap cyclically, so an order always "
         "exists\nNewell's tests: do not split, and fail on cyclic overlap"));
  rows.add(tr("Engine"), engine_, setting_tip("engine"));
  rows.add(tr("Resolution, px"), resolution_, setting_tip("resolution"));
  rows.add(tr("Painter's order"), order_, order_->toolTip());
}

void SettingsPanel::add_direction_rows(SettingRows& rows) {
  sampling_ = choice_box<Sampling>("sampling", setting_tip("sampling"));
  seed_ = named("seed", new QLineEdit, setting_tip("seed"));
  seed_->setValidator(
      new QRegularExpressionValidator(QRegularExpression(QStringLiteral("[0-9]{1,20}")), seed_));
  pass_serves_ = named("pass_serves", new QComboBox, setting_tip("one-way"));
  pass_serves_->addItems({tr("serves ω and −ω"), tr("serves ω only (paper)")});
  replicas_ = named("replicas", new QSpinBox, setting_tip("replicas"));
  replicas_->setRange(1, 64);
  replicas_->setSpecialValueText(tr("None"));
  rows.add(tr("Sampling"), sampling_, sampling_->toolTip());
  rows.add(tr("Seed"), seed_, seed_->toolTip());
  rows.add(tr("Each pass"), pass_serves_, pass_serves_->toolTip());
  rows.add(tr("Replicas"), replicas_, replicas_->toolTip());
}

void SettingsPanel::add_estimator_rows(SettingRows& rows) {
  normalize_ = choice_box<Normalization>(
      "normalize", tr("Rows: divide each row by the patch's quadrature of the cosine\n"
                      "Symmetric: scale rows and columns alike, which preserves reciprocity"));
  scheme_ = choice_box<Scheme>(
      "scheme", tr("Fixed: the same directions in every iteration\n"
                   "Growing: twice as many directions in each iteration, up to M\n"
                   "Semi-iterative: M new directions in each iteration, and the mean over "
                   "iterations\n"
                   "Conjugate gradients: one set of passes, then the linear system is solved"));
  basis_ = choice_box<Basis>(
      "basis",
      tr("Constant: one value of B per patch\n"
         "Linear: a linear function on each patch, with engines Fast, Local map and Exact "
         "numbers;\n"
         "a pass takes about one and a half times as long, form factors take nine times the "
         "memory"));
  basis_note_ = named("basis_note", note_label());
  glossy_ = named("glossy", new QCheckBox(tr("Lobes reflect too")),
                  tr("<span>Whether the lobes of materials (MTL: Ks with Ns or Pr; glTF: metal and "
                     "roughness) reflect too, so that patches look different from each point; M "
                     "directions resolve exponents n up to about M/10</span>"));
  glossy_note_ = named("glossy_note", note_label());
  rows.add(tr("B on a patch"), with_note(basis_, basis_note_), basis_->toolTip());
  glossy_column_ = with_note(glossy_, glossy_note_);
  rows.add(tr("Glossy"), glossy_column_, glossy_->toolTip());
  rows.add(tr("Normalize"), normalize_, normalize_->toolTip());
  rows.add(tr("Scheme"), scheme_, scheme_->toolTip());
}

void SettingsPanel::add_sky() {
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
  const QString tip =
      tr("Irradiance of an unobstructed patch that faces the zenith; the sky lights "
         "an open scene along directions without a patch. 0 switches the sky off");
  sky_slider_->setToolTip(tip);
  sky_value_->setToolTip(tip);
  auto* exitance = new QWidget;
  auto* row = make_row(exitance, {}, 6);
  row->addWidget(sky_slider_, 3);
  row->addWidget(sky_value_, 3);
  sky_model_ = choice_box<SkyModel>(  // in the order of SkyModel
      "sky_model",
      tr("Uniform: the same radiance from all directions, also from below\n"
         "CIE overcast: three times as bright at the zenith as at the horizon, nothing from "
         "below"));
  sky_up_ = named("sky_up", new QComboBox, tr("The direction of the zenith"));
  for (const NamedAxis& axis : named_axes()) {
    sky_up_->addItem(QString::fromUtf8(axis.name));
  }
  sky_up_->addItem(QString());  // another direction, of a session or a command line
  connect(sky_up_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    if (index < static_cast<int>(named_axes().size())) {
      emit zenith_chosen(named_axes()[static_cast<std::size_t>(index)].direction);
    }
  });
  auto* rows = new SettingRows;
  rows->add(tr("Sky, W/m²"), exitance, tip);
  rows->add(tr("Sky model"), sky_model_, sky_model_->toolTip());
  rows->add(tr("Zenith"), sky_up_, sky_up_->toolTip());
  rows->add(sun_ = new SunControls);
  connect(sun_, &SunControls::changed, this, &SettingsPanel::show_state);
  connect(sun_, &SunControls::changed, this, &SettingsPanel::sun_moved);
  add_section(sky_section_ = new Fold("sky_section", tr("Sky"), rows));
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

void SettingsPanel::add_limits() {
  stop_at_ = named("stop_at", new QComboBox,
                   tr("Whether the iterations end by their effect or by their number"));
  stop_at_->addItems({tr("Tolerance"), tr("Iterations")});
  tolerance_ = named("tolerance", new QLineEdit, setting_tip("tolerance"));
  tolerance_->setValidator(number_validator(tolerance_, 0, 1, 15));
  tolerance_->setMinimumWidth(60);
  iterations_ = named("iterations", new CountBox, setting_tip("iterations"));
  iterations_->setRange(1, 1'000'000);
  iterations_->setMinimumWidth(60);
  stop_value_ = new QStackedWidget;
  stop_value_->addWidget(tolerance_);
  stop_value_->addWidget(iterations_);
  stop_value_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  max_patch_area_ = named("max_patch_area", new QLineEdit, setting_tip("max-patch-area"));
  auto* area = new QDoubleValidator(max_patch_area_);
  area->setBottom(0);
  area->setLocale(QLocale::c());
  max_patch_area_->setValidator(area);
  max_patch_area_->setPlaceholderText(tr("Faces not divided"));
  auto* rows = new SettingRows;
  rows->add(tr("Stop at"), stop_at_, stop_at_->toolTip());
  rows->add(tr("Limit"), stop_value_, tr("Value at which the iterations end."));
  rows->add(tr("Patch area, m²"), max_patch_area_, max_patch_area_->toolTip());
  add_section(limits_ = new Fold("limits_section", tr("Limits"), rows));
}

void SettingsPanel::connect_changes() {
  connect(restart_, &QPushButton::clicked, this, &SettingsPanel::restart_clicked);
  connect(how_wrong_, &QPushButton::clicked, this, &SettingsPanel::errors_wanted);
  connect(refine_, &RefineControls::changed, this, &SettingsPanel::show_state);
  connect(quality_, &QualityControls::changed, this, &SettingsPanel::show_state);
  connect(quality_, &QualityControls::draft_chosen, replicas_, [this] { replicas_->setValue(1); });
  connect(glossy_, &QCheckBox::toggled, this, &SettingsPanel::show_state);
  for (QComboBox* box : {sampling_, engine_, order_, pass_serves_, normalize_, scheme_, basis_,
                         stop_at_, quality_->accuracy_of(), sky_model_, sky_up_}) {
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
  for (QSpinBox* box : {resolution_, replicas_, iterations_}) {
    connect(box, qOverload<int>(&QSpinBox::valueChanged), this, &SettingsPanel::show_state);
  }
  for (QLineEdit* line : {seed_, tolerance_}) {
    connect(line, &QLineEdit::textChanged, this, &SettingsPanel::show_state);
  }
  connect(patches_, qOverload<int>(&QSpinBox::valueChanged), this, &SettingsPanel::want_patches);
  for (const auto& show : {&SettingsPanel::want_forecast, &SettingsPanel::show_state}) {
    connect(max_patch_area_, &QLineEdit::textChanged, this, show);
    connect(two_sided_, &QCheckBox::toggled, this, show);
  }
}

Vec3 SettingsPanel::zenith() const {
  const int axis = sky_up_->currentIndex();
  return axis >= 0 && axis < static_cast<int>(named_axes().size())
             ? named_axes()[static_cast<std::size_t>(axis)].direction
             : other_zenith_;
}

std::vector<SunOfDay> SettingsPanel::sun_through_day(int count) const {
  return sun_->day(zenith(), count);
}

Sky SettingsPanel::sky() const {
  const Sun sun = sun_->sun(zenith());
  if (!(sky_value_->value() > 0) || !takes_directions(engine_of(*engine_))) {
    Sky none;
    none.sun = sun;
    return none;
  }
  Sky sky = base_.sky;  // with all its digits, unless changed
  sky.sun = sun;
  if (sky_value_->value() !=
      sky_value_->valueFromText(sky_value_->textFromValue(max_abs(base_.sky.exitance)))) {
    sky.exitance = sky_value_->value() * sky_color_;
  }
  sky.model = static_cast<SkyModel>(sky_model_->currentIndex());
  sky.up = sky.model == SkyModel::uniform ? Sky().up : zenith();  // read by other models only
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
  sun_->set_sun(sky.sun, zenith());
}

void SettingsPanel::choose_up(const Vec3& up) {
  const auto found = std::find_if(named_axes().begin(), named_axes().end(),
                                  [&up](const NamedAxis& axis) { return axis.direction == up; });
  const int index = static_cast<int>(found - named_axes().begin());
  if (found == named_axes().end()) {
    sky_up_->setItemText(index, vector_text(up));
    other_zenith_ = up;
  }
  sky_up_->setCurrentIndex(index);
}

void SettingsPanel::set_scene_up(const Vec3& up) {
  const Sun sun = sun_->sun(zenith());
  choose_up(up);
  sun_->show_sun(sun, zenith());
}

RefineChoice SettingsPanel::refinement() const {
  RefineChoice refine = refine_->choice();
  if (fixed_ || total()) {
    refine.by.reset();
  }
  return refine;
}

bool SettingsPanel::total() const { return !fixed_ && quality_->total(); }

SolveOptions SettingsPanel::solve_options() const {
  SolveOptions options = base_;
  quality_->write_to(options);
  options.basis = static_cast<Basis>(basis_->currentIndex());
  options.glossy = glossy_->isChecked();
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
  quality_->set_options(solve);
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
  tolerance_->setText(exact_digits(solve.tolerance));
  set_sky(solve.sky);
  two_sided_->setChecked(scene.two_sided);
  patches_wanted_ = 0;
  max_patch_area_->setText(scene.max_patch_area > 0 ? exact_digits(scene.max_patch_area)
                                                    : QString());
  show_state();
}

void SettingsPanel::set_options(const RunOptions& options) {
  RefineChoice refine = options.refine;
  if (options.total && refine.patches == 0) {
    refine.patches = static_cast<int>(TotalGoal().patches);
  }
  refine_->set_choice(refine);
  quality_->set_total(options.total);
  set_options(options.solve, options.scene);
}

void SettingsPanel::set_in_effect(const std::shared_ptr<const SolverSnapshot>& snapshot,
                                  const SceneOptions& scene) {
  in_effect_ = snapshot;
  solve_in_effect_ = snapshot->options;
  scene_in_effect_ = scene;
  refine_in_effect_ = snapshot->refine;
  total_in_effect_ = snapshot->total.has_value();
  show_state();
}

bool SettingsPanel::differ_from_effect() const {
  const auto limit = [](const RefineChoice& refine) {
    return refine.patches > 0 ? refine.patches : TotalGoal().patches;
  };
  return !is_run_of(solve_in_effect_, solve_options()) || total() != total_in_effect_ ||
         (total() && limit(refinement()) != limit(refine_in_effect_)) || patches_wanted_ > 0 ||
         !same(scene_options(), scene_in_effect_) || !(refinement() == refine_in_effect_);
}

void SettingsPanel::set_restart_enabled(bool enabled) {
  enabled_ = enabled;
  show_state();
}

void SettingsPanel::set_scene_fixed(bool fixed) {
  fixed_ = fixed;
  show_state();
}

void SettingsPanel::want_patches(int patches) {
  if (patches == 0) {
    patches_wanted_ = 0;
    max_patch_area_->clear();
    show_state();
    return;
  }
  patches_wanted_ = patches;
  if (enabled_) {
    emit forecast_wanted(scene_options());
  }
  show_state();
}

void SettingsPanel::want_forecast() {
  patches_wanted_ = 0;
  forecast_.reset();
  if (enabled_ && !same(scene_options(), scene_in_effect_)) {
    emit forecast_wanted(scene_options());
  }
}

void SettingsPanel::show_forecast(const SceneOptions& options, std::int64_t patches) {
  if (patches_wanted_ == 0 && same(options, scene_options())) {
    forecast_ = patches;
    show_state();
  }
}

void SettingsPanel::set_patch_area(std::int64_t wanted, double area, std::int64_t patches) {
  if (wanted != patches_wanted_) {
    return;
  }
  {
    const QSignalBlocker quiet(max_patch_area_);
    max_patch_area_->setText(area > 0 ? exact_digits(area) : QString());
  }
  patches_wanted_ = 0;
  forecast_ = patches;
  show_state();
}

}  // namespace transillum::viewer

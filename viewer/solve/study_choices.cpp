// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The left side of the study dialog. Everything without a check box is taken over from the options
// of the current solve.
#include "solve/study_choices.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>

#include "support/number_text.h"
#include "transillum/errors.h"
#include "widgets/build.h"
#include "widgets/engine_text.h"

namespace transillum::viewer {

namespace {

constexpr int first_directions = 16, last_directions = 16384;
constexpr int largest_by_default = 512;

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  set_strong(*label);
  return label;
}

bool is_valid(const SolveOptions& options) {
  try {
    options.validate();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

StudyChoices::StudyChoices(QWidget* parent) : QWidget(parent) {
  auto* layout = make_column(this, {}, 4);

  layout->addWidget(heading(tr("Samplings")));
  for (std::size_t k = 0; k < names_of<Sampling>().size(); ++k) {
    const auto sampling = static_cast<Sampling>(k);
    const bool on = sampling == Sampling::random || sampling == Sampling::hammersley ||
                    sampling == default_sampling(true);
    const QString name = QString::fromStdString(name_of(sampling));
    layout->addWidget(add_box(samplings_, name, capitalized(name), static_cast<int>(k), on));
  }
  layout->addSpacing(10);

  layout->addWidget(heading(tr("Each pass serves")));
  layout->addWidget(add_box(passes_, QStringLiteral("two_way"), tr("ω and −ω"), 1, true));
  layout->addWidget(
      add_box(passes_, QStringLiteral("one_way"), tr("ω only, as in the paper"), 0, false));
  layout->addSpacing(10);

  layout->addWidget(heading(tr("Engines")));
  auto* engines = new QGridLayout;
  engines->setVerticalSpacing(4);
  for (std::size_t k = 0; k < names_of<Engine>().size(); ++k) {
    const auto engine = static_cast<Engine>(k);
    if (!takes_directions(engine)) {
      continue;  // their error does not depend on M
    }
    const QString name = QString::fromStdString(name_of(engine));
    QCheckBox* box = add_box(engines_, QStringLiteral("engine_") + name, engine_label(engine),
                             static_cast<int>(k), engine == solve_.engine);
    box->setToolTip(engine_sentence(engine));
    const int place = static_cast<int>(engines_.size()) - 1;
    engines->addWidget(box, place / 2, place % 2);
  }
  layout->addLayout(engines);
  layout->addSpacing(10);

  layout->addWidget(heading(tr("Passes")));
  auto* grid = new QGridLayout;
  grid->setVerticalSpacing(4);
  constexpr int columns = 3;
  for (int m = first_directions, k = 0; m <= last_directions; m *= 2, ++k) {
    grid->addWidget(
        add_box(directions_, QString::number(m), count_text(m), m, m <= largest_by_default),
        k / columns, k % columns);
  }
  layout->addLayout(grid);
  layout->addSpacing(10);

  cost_ = named("study_size", new QLabel);
  fixed_settings_ = new QLabel;
  for (QLabel* label : {cost_, fixed_settings_}) {
    label->setWordWrap(true);
    label->setForegroundRole(QPalette::PlaceholderText);
    layout->addWidget(label);
  }
  fixed_settings_->setToolTip(tr("The Solve settings that the current solve was started with"));
  layout->addStretch(1);
  show_solve();
}

QCheckBox* StudyChoices::add_box(std::vector<Choice>& choices, const QString& name,
                                 const QString& text, int value, bool on) {
  auto* box = named(QStringLiteral("study_%1").arg(name), new QCheckBox(text));
  box->setChecked(on);
  connect(box, &QCheckBox::toggled, this, [this] {
    show_cost();
    emit changed();
  });
  choices.push_back({box, value});
  return box;
}

void StudyChoices::set_solve(const SolveOptions& solve) {
  if (solve == solve_) {
    return;
  }
  const bool another_engine = solve.engine != solve_.engine;
  solve_ = solve;
  if (another_engine) {
    check_engine();
  }
  show_solve();
  emit changed();
}

void StudyChoices::check_engine() {
  for (const Choice& choice : engines_) {
    const QSignalBlocker quiet(choice.box);
    choice.box->setChecked(choice.value == static_cast<int>(solve_.engine));
  }
}

std::vector<Engine> StudyChoices::engines() const {
  std::vector<Engine> engines;
  for (const Choice& choice : engines_) {
    if (choice.box->isChecked()) {
      engines.push_back(static_cast<Engine>(choice.value));
    }
  }
  return engines.empty() ? std::vector<Engine>{solve_.engine} : engines;
}

void StudyChoices::show_solve() {
  fixed_settings_->setText(tr("From the current solve: normalization %1, scheme %2")
                               .arg(capitalized(QString::fromStdString(name_of(solve_.normalize))),
                                    capitalized(QString::fromStdString(name_of(solve_.scheme)))));
  show_cost();
}

StudyOptions StudyChoices::options() const {
  StudyOptions options;
  options.solve.engine_options = solve_.engine_options;
  options.solve.seed = solve_.seed;
  options.solve.burn_in = solve_.burn_in;
  options.solve.memory = solve_.memory;
  options.solve.threads = solve_.threads;
  for (const Choice& choice : directions_) {
    if (choice.box->isChecked()) {
      options.directions.push_back(choice.value);
    }
  }
  for (const Choice& sampling : samplings_) {
    for (const Choice& pass : passes_) {
      if (!sampling.box->isChecked() || !pass.box->isChecked()) {
        continue;
      }
      for (const Engine engine : engines()) {
        const int resolution = engine == solve_.engine ? solve_.engine_options.resolution : 0;
        const StudySeries series{static_cast<Sampling>(sampling.value),
                                 pass.value == 1,
                                 solve_.normalize,
                                 solve_.scheme,
                                 solve_.first_shot,
                                 engine,
                                 resolution};
        if (is_valid(options.solve_options(series, first_directions))) {
          options.series.push_back(series);
        }
      }
    }
  }
  return options;
}

void StudyChoices::show_cost() {
  const StudyOptions options = this->options();
  if (options.series.empty() || options.directions.empty()) {
    cost_->setText(tr("Choose a sampling, what a pass serves, and a number of passes"));
    return;
  }
  // The number of iterations of a burn-in depends on the scene's reflectances.
  bool exact = true;
  std::int64_t passes = 0;
  for (const StudySeries& series : options.series) {
    for (const int m : options.directions) {
      const SolveOptions solve = options.solve_options(series, m);
      const double iterations = expected_iterations_with_passes(solve, 0);
      passes += std::int64_t{m} * static_cast<std::int64_t>(iterations);
      exact = exact && (solve.scheme != Scheme::semi_iterative || solve.burn_in.has_value());
    }
  }
  cost_->setText(
      (exact ? tr("%1 passes, plus %2 for the reference unless it is in the cache")
             : tr("More than %1 passes, plus %2 for the reference unless it is in the cache"))
          .arg(count_text(passes), count_text(options.reference().directions)));
}

}  // namespace transillum::viewer

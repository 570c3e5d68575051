// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Quantities of the patches, and the colors and ranges chosen for them. Snapshots come from
// solved_snapshot(), without a window.
#include "colors/color_choice.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "colors/pointer_label.h"
#include "model/run_comparison.h"
#include "model/snapshot_values.h"
#include "registered.h"
#include "solved_snapshot.h"

namespace transillum::viewer::color_choice_test {

namespace {

std::shared_ptr<SolverSnapshot> solved(const char* spec, int replicas = 1) {
  return test::solved_snapshot(spec, 64, replicas);
}

std::shared_ptr<SolverSnapshot> times(const SolverSnapshot& snapshot, double factor) {
  auto scaled = std::make_shared<SolverSnapshot>(snapshot);
  for (Rgb& b : scaled->radiosity) {
    b = factor * b;
  }
  return scaled;
}

/// Differences are of patches that reflect and do not emit.
bool is_omitted(const Scene& scene, PatchId i) {
  return max_abs(scene.exitance(i)) > 0 || max_abs(scene.reflectance(i)) == 0;
}

}  // namespace

class ColorChoiceTest : public QObject {
  Q_OBJECT

  Selection selection_;

 private slots:
  void every_quantity_has_values_or_a_reason_why_not() {
    const auto snapshot = solved("cornell-box", 4);
    for (const QuantityTraits& traits : quantity_traits()) {
      QCOMPARE(&traits_of(traits.quantity), &traits);
      for (const PatchId selected : {no_patch, PatchId{3}}) {
        const PatchResponse response{
            snapshot->loaded, 3,
            solve_adjoint(*snapshot->loaded->scene, *snapshot->form_factors, 3,
                          snapshot->loaded->scene->materials())};
        const PatchValues shown =
            values_of(traits.quantity, *snapshot, selected, nullptr, &response);
        QVERIFY2(shown.values.empty() != shown.missing.isEmpty(), traits.name);
        if (!shown.values.empty()) {
          QCOMPARE(shown.values.size(), std::size_t(snapshot->loaded->scene->patch_count()));
        }
        if (traits.of_selection) {
          QCOMPARE(shown.values.empty(), selected == no_patch);
        }
      }
    }
    QVERIFY(!values_of(Quantity::difference, *snapshot, 0, nullptr).missing.isEmpty());
    QVERIFY(values_of(Quantity::difference, *snapshot, 0, snapshot.get()).missing.isEmpty());
    const auto dark = times(*snapshot, 0);
    QVERIFY(values_of(Quantity::difference, *snapshot, 0, dark.get()).missing.contains("no light"));
  }

  void quantities_agree_with_the_equations() {
    const auto snapshot = solved("cornell-box");
    const Scene& scene = *snapshot->loaded->scene;
    const auto of = [&](Quantity quantity) {
      return values_of(quantity, *snapshot, 2, nullptr).values;
    };
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      // B(1) = E + rho H(0), and before it B(0) = E.
      const Rgb b =
          of(Quantity::exitance)[at] + of(Quantity::reflectance)[at] * of(Quantity::irradiance)[at];
      QVERIFY(max_abs(b - of(Quantity::radiosity)[at]) <= 1e-12 * (1 + max_abs(b)));
      QVERIFY(max_abs(of(Quantity::last_change)[at] - (b - scene.exitance(i))) <= 1e-12);
      QVERIFY(of(Quantity::fragments)[at].r >= 1);
    }
    double sum = 0;
    for (const Rgb& f : of(Quantity::form_factor_from)) {
      sum += f.r;
    }
    QVERIFY(std::abs(sum - snapshot->form_factor_sums[2]) < 1e-12);
    // Reciprocity: A_i F_ij = A_j F_ji.
    const auto from = of(Quantity::form_factor_from), to = of(Quantity::form_factor_to);
    for (PatchId j = 0; j < scene.patch_count(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      QVERIFY(std::abs(scene.patch(2).area * from[at].r - scene.patch(j).area * to[at].r) < 1e-12);
    }
  }

  void an_error_estimate_requires_replicas() {
    QVERIFY(!values_of(Quantity::error, *solved("furnace"), 0, nullptr).missing.isEmpty());
    QVERIFY(values_of(Quantity::error, *solved("furnace", 4), 0, nullptr).missing.isEmpty());
  }

  void a_new_selection_recolors_form_factors() {
    Selection selection;
    ColorChoice colors(selection);
    QSignalSpy requested(&colors, &ColorChoice::form_factors_requested);
    colors.fit(solved("cornell-box"));
    colors.set_quantity(Quantity::form_factor_from);
    QCOMPARE(requested.count(), 1);
    QVERIFY(colors.values().empty());
    QVERIFY(!colors.missing().isEmpty());
    for (const Color8& color : colors.patch_colors()) {
      QVERIFY(color[0] == color[2]);
    }
    QSignalSpy changed(&colors, &ColorChoice::changed);
    selection.select(2);
    QCOMPARE(changed.count(), 1);
    QVERIFY(colors.missing().isEmpty());
    // The form factor of a patch to itself is 0.
    QCOMPARE(colors.patch_colors()[2], zero_color);
    const auto before = colors.patch_colors();
    selection.select(0);
    QCOMPARE(colors.patch_colors()[0], zero_color);
    QVERIFY(colors.patch_colors() != before);
  }

  void form_factors_are_logarithmic_unless_chosen_otherwise() {
    Selection selection;
    selection.select(2);
    ColorChoice colors(selection);
    colors.set_mode(ColorMode::luminance);
    colors.fit(solved("cornell-box"));
    QVERIFY(!colors.scale().logarithmic && !colors.scale().marks_zero);
    colors.set_quantity(Quantity::form_factor_from);
    QVERIFY(colors.scale().logarithmic);
    const auto marked = [&colors] {
      for (std::size_t i = 0; i < colors.values().size(); ++i) {
        if ((colors.values()[i].r == 0) != (colors.patch_colors()[i] == zero_color)) {
          return false;
        }
      }
      return colors.scale().zeros;
    };
    QVERIFY(marked());
    // A linear scale marks zeros too; the choice stays with the form factors.
    colors.set_logarithmic(false);
    QVERIFY(!colors.scale().logarithmic && marked());
    colors.set_quantity(Quantity::radiosity);
    colors.set_logarithmic(true);
    colors.set_quantity(Quantity::form_factor_to);
    QVERIFY(!colors.scale().logarithmic);
    colors.set_quantity(Quantity::irradiance);
    QVERIFY(colors.scale().logarithmic);
  }

  void a_range_is_fitted_fixed_or_widened() {
    ColorChoice colors(selection_);
    const auto snapshot = solved("cornell-box");
    colors.set_mode(ColorMode::luminance);
    colors.fit(snapshot);
    const double high = colors.scale().high;
    colors.fit(times(*snapshot, 0.5));
    QCOMPARE(colors.scale().high, 0.5 * high);

    colors.set_range_rule(RangeRule::widening);
    colors.fit(times(*snapshot, 2));
    QCOMPARE(colors.scale().high, 2 * high);
    colors.fit(snapshot);
    QCOMPARE(colors.scale().high, 2 * high);

    colors.set_range(0.25 * high, 0.5 * high);
    QVERIFY(colors.range_rule() == RangeRule::fixed);
    colors.fit(snapshot);
    QCOMPARE(colors.scale().low, 0.25 * high);
    QCOMPARE(colors.scale().high, 0.5 * high);
    QVERIFY(colors.scale().above && colors.scale().below);
    // A fixed range does not apply to another quantity.
    colors.set_quantity(Quantity::fragments);
    QVERIFY(colors.range_rule() == RangeRule::automatic);
  }

  void an_invalid_range_is_repaired() {
    ColorChoice colors(selection_);
    colors.set_mode(ColorMode::luminance);
    colors.fit(solved("furnace"));
    colors.set_range(3, 3);
    QVERIFY(colors.scale().low < colors.scale().high);
    colors.set_range(-1, -5);
    QVERIFY(colors.scale().low < colors.scale().high);
    colors.set_logarithmic(true);
    QVERIFY(colors.scale().low > 0 && colors.scale().low < colors.scale().high);
  }

  void a_difference_of_zero_is_white() {
    ColorChoice colors(selection_);
    const auto snapshot = solved("cornell-box");
    colors.fit(snapshot);
    colors.set_quantity(Quantity::difference);
    QVERIFY(!colors.missing().isEmpty());
    colors.keep_run();
    QVERIFY(colors.missing().isEmpty());
    for (PatchId i = 0; i < snapshot->loaded->scene->patch_count(); ++i) {
      QCOMPARE(at(colors.patch_colors(), i), is_omitted(*snapshot->loaded->scene, i)
                                                 ? omitted_color
                                                 : color_of(ColorMap::diverging, 0.5));
    }
    colors.fit(times(*snapshot, 1.25));
    QCOMPARE(colors.scale().low, -colors.scale().high);
    bool any = false;
    const std::vector<Rgb> units = compare_runs(*snapshot, *snapshot).units;
    for (std::size_t i = 0; i < colors.values().size(); ++i) {
      const Rgb& unit = units[i];
      const Rgb expected =
          25 * snapshot->radiosity[i] * Rgb{1 / unit.r, 1 / unit.g, 1 / unit.b};  // percent
      QVERIFY(max_abs(unit) == 0 || max_abs(colors.values()[i] - expected) < 1e-9);
      any = any || colors.patch_colors()[i] == color_of(ColorMap::diverging, 1);
    }
    QVERIFY(any);
  }

  void the_kept_run_is_shown_with_the_same_scale() {
    ColorChoice colors(selection_);
    const auto first = solved("cornell-box");
    colors.fit(first);
    const auto first_colors = colors.patch_colors();
    colors.show_kept_run(true);
    QVERIFY(!colors.shows_kept_run());  // there is none
    colors.keep_run();
    colors.fit(times(*first, 0.5));
    const double exposure = colors.scale().exposure;
    const auto second_colors = colors.patch_colors();
    colors.show_kept_run(true);
    QVERIFY(colors.patch_colors() != second_colors);
    QCOMPARE(colors.scale().exposure, exposure);
    colors.show_kept_run(false);
    QVERIFY(colors.patch_colors() == second_colors);
  }

  void any_two_kept_runs_of_the_same_patches_are_compared() {
    ColorChoice colors(selection_);
    KeptRuns& runs = colors.kept_runs();
    const auto base = solved("cornell-box");
    colors.set_quantity(Quantity::difference);
    for (const double factor : {1.0, 1.25, 2.0}) {
      colors.fit(times(*base, factor));
      if (factor < 2) {
        QVERIFY(colors.keep_run());
      }
    }
    // Whether the difference shown is `factor` times the run A in B - E, in percent of its level.
    const std::vector<Rgb> of_one =
        values_of(Quantity::difference, *times(*base, 2), 0, base.get()).values;
    const auto is_shown = [&](double factor) {
      for (std::size_t i = 0; i < base->radiosity.size(); ++i) {
        const Rgb& shown = colors.values().at(i);
        const bool omitted = is_omitted(*base->loaded->scene, static_cast<PatchId>(i));
        if (omitted != std::isnan(shown.r) ||
            (!omitted && !(max_abs(shown - factor * of_one.at(i)) < 1e-9))) {
          return false;
        }
      }
      return true;
    };
    QCOMPARE(runs.first(), 1);
    QCOMPARE(runs.second(), -1);
    QVERIFY(is_shown(0.75 / 1.25));
    runs.set_first(0);
    QVERIFY(is_shown(1));
    runs.set_second(1);
    QVERIFY(is_shown(0.25));
    // Each surface is off by a fourth of its own level.
    const ResultComparison comparison = compare_runs(*colors.run_a(), *colors.run_b());
    QVERIFY(comparison.surfaces.size() > 1);
    for (const SurfaceDifference& surface : comparison.surfaces) {
      QVERIFY(std::abs(surface.rms - 0.25) < 1e-12);
    }
    QVERIFY(std::abs(comparison.rms - 0.25) < 1e-12);
    const PatchId worst = comparison.surfaces.front().worst;
    QVERIFY(max_abs(base->loaded->scene->exitance(worst)) == 0);
    QCOMPARE(compare_runs(*base, *base).surfaces.front().worst, no_patch);

    runs.remove(1);
    QCOMPARE(runs.second(), -1);
    QVERIFY(is_shown(1));
  }

  /// A lamp has no difference: it is gray, whatever its B, and the pointer says why.
  void lamps_are_omitted_from_the_difference() {
    ColorChoice colors(selection_);
    const auto base = solved("cornell-box");
    colors.set_quantity(Quantity::difference);
    colors.fit(base);
    QVERIFY(colors.keep_run());
    colors.fit(times(*base, 1.5));
    const Scene& scene = *base->loaded->scene;
    int lamps = 0;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      lamps += max_abs(scene.exitance(i)) > 0 ? 1 : 0;
      QCOMPARE(at(colors.patch_colors(), i) == omitted_color, is_omitted(scene, i));
      QCOMPARE(pointer_text(colors, {i, {}}).contains("omitted"), is_omitted(scene, i));
    }
    QVERIFY(lamps > 0);
    QVERIFY(colors.scale().high < 1000);
  }

  void runs_of_other_patches_say_why_they_cannot_be_compared() {
    ColorChoice colors(selection_);
    KeptRuns& runs = colors.kept_runs();
    colors.fit(solved("cornell-box"));
    QVERIFY(colors.keep_run());
    QVERIFY(runs.reason_against(0).isEmpty());
    QVERIFY(!runs.run(0)->form_factors);  // they take far more memory than B
    colors.fit(solved("furnace"));
    QVERIFY2(runs.reason_against(0).contains("cornell-box"), qPrintable(runs.reason_against(0)));
    QVERIFY(!colors.run_a());
    runs.set_first(0);
    runs.set_second(0);
    QCOMPARE(runs.first(), -1);
    QCOMPARE(runs.second(), -1);
    colors.set_quantity(Quantity::difference);
    QVERIFY(colors.values().empty() && !colors.missing().isEmpty());
    // The same patches are read again.
    colors.fit(solved("cornell-box"));
    QVERIFY(runs.reason_against(0).isEmpty());
    QVERIFY(colors.run_a() == runs.run(0));
    QVERIFY(!runs.keep(*colors.snapshot(), 1000));
    QCOMPARE(runs.all().size(), std::size_t{1});
  }

  void the_histogram_is_weighted_by_area() {
    const auto scene_of_values = load_scene("cornell-box");
    const Scene& scene = *scene_of_values;
    std::vector<Rgb> values(static_cast<std::size_t>(scene.patch_count()), Rgb{0.9, 0, 0});
    values[0] = {0.1, 0, 0};
    values[1] = {5, 0, 0};  // beyond the range
    ColorScale scale;
    scale.mode = ColorMode::red;
    const std::vector<double> fractions = histogram(scale, scene, values, 10);
    double rest = 0;
    for (PatchId i = 2; i < scene.patch_count(); ++i) {
      rest += scene.patch(i).area;
    }
    QCOMPARE(fractions[9], 1.0);
    QVERIFY(std::abs(fractions[1] - scene.patch(0).area / rest) < 1e-12);
    QCOMPARE(fractions[5], 0.0);
  }
};

const test::Registered registered("color_choice", test::run_without_application<ColorChoiceTest>);

}  // namespace transillum::viewer::color_choice_test

#include "color_choice_test.moc"

// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sharp picture, and the light map below it: when they are made and hidden, and that their
// pixels are the light of the solution.
#include <QAction>
#include <QLabel>
#include <QTemporaryDir>
#include <QToolButton>
#include <cmath>
#include <memory>
#include <numbers>

#include "model/snapshot_values.h"
#include "scene/color_controls.h"
#include "transillum/picture.h"
#include "window/files/export_actions.h"
#include "window_support.h"

namespace transillum::viewer::sharp_test {

using namespace test;

namespace {

/// A solved scene whose picture has only surfaces, with sharp pictures.
struct SharpWindow {
  std::unique_ptr<TestWindow> window;
  SceneView* scene_view = nullptr;
  SharpView* sharp = nullptr;
  bool ready = false;

  explicit SharpWindow(const QString& scene = "cornell-box", bool glossy = false) {
    const SolveOptions options{.directions = 128, .first_shot = {}, .glossy = glossy};
    window = make_window(options);
    window->set_options(options, {.max_patch_area = glossy ? 0.05 : 0.01});
    window->resize(window->minimumSizeHint());
    scene_view = window->findChild<SceneView*>();
    sharp = window->views().page.sharp();
    window->open(scene);
    ready = wait_for([this] { return window->runner.state() == RunState::finished; }) &&
            comes_to_rest(*window);
    window->views().page.color_controls()->set_outlines(false);
    window->views().page.color_controls()->set_direction(false);
  }
  /// Waits until it has been made.
  bool becomes_sharp() const {
    sharp->action()->setChecked(true);
    return ready &&
           wait_for([this] { return !scene_view->sharp().isNull() && sharp->settled(); }) &&
           comes_to_rest(*window);
  }
  SharpSubject subject() const { return *scene_view->sharp_subject(); }
};

/// The light of what is shown, for comparison.
struct ShownLight {
  SharpSubject subject;
  std::shared_ptr<const Scene> scene;
  SurfaceLight light;
  CameraRays rays;

  explicit ShownLight(const SharpSubject& shown)
      : subject(shown),
        scene(scene_of(*shown.snapshot)),
        light(solution_of_scene()),
        rays(*scene,
             {.eye = shown.view.eye,
              .target = shown.view.target,
              .up = shown.view.up,
              .field_of_view = shown.view.view_angle},
             shown.size.width(), shown.size.height()) {}

  static std::shared_ptr<const Scene> scene_of(const SolverSnapshot& snapshot) {
    const auto& own = snapshot.loaded->scene;
    return snapshot.materials ? std::make_shared<const Scene>(*own, snapshot.materials->materials,
                                                              snapshot.materials->of_patch)
                              : own;
  }
  std::shared_ptr<const Solution> solution_of_scene() const {
    auto solution = std::make_shared<Solution>(solution_of(*subject.snapshot));
    solution->scene = scene;
    return solution;
  }
  double factor() const { return subject.by_eye ? 1 : std::numbers::pi; }
  /// Whether all of a pixel shows patches, none of which is too bright for its color.
  bool is_plain(int column, int row) const {
    for (int k = 0; k < SharpRenderer::samples; ++k) {
      const auto [ray, salt] = sample_ray(rays, {column, row, k, SharpRenderer::samples});
      const Rgb b = factor() * light.radiance(ray.origin, ray.direction, salt);
      if (!subject.loaded->picker->first_lit_hit(ray.origin, ray.direction) ||
          std::exp2(subject.scale.exposure) * max_abs(b) > 1) {
        return false;
      }
    }
    return true;
  }
  QColor color(int column, int row) const {
    const Rgb radiance = pixel_radiance(light, rays, column, row, SharpRenderer::samples);
    const Color8 color = subject.scale.shown(subject.scale.exposed(factor() * radiance));
    return {color[0], color[1], color[2]};
  }
};

int difference(const QColor& a, const QColor& b) {
  return std::max({std::abs(a.red() - b.red()), std::abs(a.green() - b.green()),
                   std::abs(a.blue() - b.blue())});
}

/// The number of pixels compared, of a grid, and of those that differ from the light.
struct Compared {
  int pixels = 0, different = 0;
};
Compared compare(const QImage& picture, const ShownLight& shown) {
  Compared result;
  for (int row = 3; row < picture.height(); row += 11) {
    for (int column = 3; column < picture.width(); column += 11) {
      if (shown.is_plain(column, row)) {
        ++result.pixels;
        constexpr int rounding = 1;
        result.different +=
            difference(picture.pixelColor(column, row), shown.color(column, row)) > rounding;
      }
    }
  }
  return result;
}

/// The mean difference of a picture from the light, over a grid of its plain pixels, in levels of
/// gray.
double mean_difference(const QImage& picture, const ShownLight& shown) {
  double sum = 0;
  int pixels = 0;
  for (int row = 3; row < picture.height(); row += 7) {
    for (int column = 3; column < picture.width(); column += 7) {
      if (shown.is_plain(column, row)) {
        ++pixels;
        sum += difference(picture.pixelColor(column, row), shown.color(column, row));
      }
    }
  }
  return pixels > 300 ? sum / pixels : HUGE_VAL;
}

/// Turns the scene with the button held, as long as this exists.
class HeldDrag {
 public:
  HeldDrag(QWidget& canvas, const QPoint& by) : canvas_(canvas), end_(canvas.rect().center() + by) {
    QTest::mousePress(&canvas_, Qt::LeftButton, {}, canvas_.rect().center());
    QMouseEvent move(QEvent::MouseMove, end_, canvas_.mapToGlobal(end_), Qt::LeftButton,
                     Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&canvas_, &move);
  }
  ~HeldDrag() { QTest::mouseRelease(&canvas_, Qt::LeftButton, {}, end_); }
  HeldDrag(const HeldDrag&) = delete;
  HeldDrag& operator=(const HeldDrag&) = delete;

 private:
  QWidget& canvas_;
  QPoint end_;
};

double brightness(const QImage& picture) {
  double sum = 0;
  for (int y = 0; y < picture.height(); y += 3) {
    for (int x = 0; x < picture.width(); x += 3) {
      sum += qGray(picture.pixel(x, y));
    }
  }
  return sum / (picture.width() * picture.height() / 9.0);
}

}  // namespace

class SharpTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanupTestCase() { common_.reset(); }

  void a_scene_at_rest_shows_the_light_of_every_pixel() {
    const SharpWindow shown;
    const QImage flat = shown.scene_view->picture(1);
    QVERIFY(shown.becomes_sharp());
    const QImage sharp = shown.scene_view->sharp();
    QCOMPARE(sharp.size(), flat.size());
    const Compared compared = compare(sharp, ShownLight(shown.subject()));
    QVERIFY2(compared.pixels > 300, qPrintable(QString::number(compared.pixels)));
    QCOMPARE(compared.different, 0);
    // Every pixel is on the screen as it was made.
    shown.scene_view->set_antialiased(false);
    QCOMPARE(different_pixels(shown.scene_view->picture(1).convertToFormat(QImage::Format_RGB32),
                              sharp.convertToFormat(QImage::Format_RGB32)),
             0);
    // Both pictures have the same exposure.
    QVERIFY(std::abs(brightness(sharp) - brightness(flat)) < 0.05 * brightness(flat));
    save_picture(*shown.window, "sharp");
  }

  void the_picture_is_the_same_for_any_number_of_threads() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    SharpSubject subject = shown.subject();
    auto one_thread = std::make_shared<SolverSnapshot>(*subject.snapshot);
    one_thread->options.threads = 1;
    subject.snapshot = one_thread;
    QImage picture;
    int deliveries = 0;
    SharpRenderer().render(subject, false, {},
                           [&](const QImage& image, const SharpProgress& progress) {
                             ++deliveries;
                             picture = progress.finished ? image.copy() : QImage();
                           });
    QVERIFY(deliveries > 1);
    QCOMPARE(picture, shown.scene_view->sharp());
  }

  void a_movement_hides_it_at_once() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    const QImage before = shown.scene_view->sharp();
    drag(*shown.scene_view->canvas(), shown.scene_view->canvas()->rect().center(), {40, 10});
    QVERIFY(shown.scene_view->sharp().isNull());
    QVERIFY(!shown.sharp->settled());
    QVERIFY(shown.becomes_sharp());
    QVERIFY(shown.scene_view->sharp() != before);
    QCOMPARE(compare(shown.scene_view->sharp(), ShownLight(shown.subject())).different, 0);
  }

  void surfaces_have_the_light_while_the_camera_moves() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    QVERIFY(wait_for([&] { return shown.sharp->has_map(); }));
    const HeldDrag drag(*shown.scene_view->canvas(), {40, 10});
    QVERIFY(shown.scene_view->sharp().isNull());
    const QImage moving = shown.scene_view->picture(1);
    const double difference_of_map = mean_difference(moving, ShownLight(shown.subject()));
    // The scale acts on it at once.
    shown.window->colors.set_exposure(shown.window->colors.scale().exposure - 0.5);
    const QImage darker = shown.scene_view->picture(1);
    const ShownLight light(shown.subject());
    const double difference_of_darker = mean_difference(darker, light);
    shown.sharp->action()->setChecked(false);
    const double difference_of_patches = mean_difference(shown.scene_view->picture(1), light);
    qInfo("mean difference from the light: %.2f, darker %.2f, of patches %.2f", difference_of_map,
          difference_of_darker, difference_of_patches);
    QVERIFY(difference_of_map < 1.0);
    QVERIFY(difference_of_darker < 1.0);
    QVERIFY(difference_of_patches > 3 * difference_of_darker);
    // The light map is kept while sharp pictures are off.
    shown.sharp->action()->setChecked(true);
    QCOMPARE(different_pixels(shown.scene_view->picture(1), darker), 0);
  }

  void surfaces_without_lobes_have_the_light_while_the_camera_moves() {
    const SharpWindow shown("gallery", true);
    shown.window->colors.set_quantity(Quantity::eye_radiance);
    QVERIFY(shown.becomes_sharp());
    QVERIFY(wait_for([&] { return shown.sharp->has_map(); }));
    QVERIFY(shown.subject().by_eye);
    const HeldDrag drag(*shown.scene_view->canvas(), {40, 10});
    QVERIFY(wait_for([&] { return !shown.window->colors.busy(); }));
    const ShownLight light(shown.subject());
    const double of_map = mean_difference(shown.scene_view->picture(1), light);
    shown.sharp->action()->setChecked(false);
    const double of_patches = mean_difference(shown.scene_view->picture(1), light);
    qInfo("mean difference from the light: %.2f, of patches %.2f", of_map, of_patches);
    QVERIFY(of_map < 0.6 * of_patches);
  }

  void a_light_map_is_of_the_shown_snapshot_only() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    QVERIFY(wait_for([&] { return shown.sharp->has_map(); }));
    MaterialEdits& edits = shown.window->relighting.edits();
    const PatchId lamp = shown.scene_view->patch_at(shown.scene_view->canvas()->rect().center());
    const Scene& scene = *shown.window->snapshot()->loaded->scene;
    edits.set_exitance(MaterialEdits::target_of(scene, TargetKind::material, lamp), {0, 0, 40});
    QVERIFY(wait_for([&] { return shown.window->snapshot()->materials != nullptr; }));
    const HeldDrag drag(*shown.scene_view->canvas(), {40, 10});
    QVERIFY(fraction_in_own_color(*shown.scene_view, shown.window->colors) > 0.95);
  }

  void a_scene_with_too_many_patches_has_no_light_map() {
    const SharpWindow shown;
    QVERIFY(shown.ready);
    auto many = std::make_shared<SolverSnapshot>(*shown.window->snapshot());
    QVERIFY(why_no_map(*many).isEmpty());
    auto loaded = std::make_shared<LoadedScene>(*many->loaded);
    loaded->scene = load_scene("cornell-box", {.max_patch_area = 1.2e-4});
    many->loaded = loaded;
    QVERIFY2(why_no_map(*many).contains("up to 20000 patches"), qPrintable(why_no_map(*many)));
  }

  void a_lamp_made_in_the_window_lights_it() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    MaterialEdits& edits = shown.window->relighting.edits();
    const PatchId lamp = shown.scene_view->patch_at(shown.scene_view->canvas()->rect().center());
    QVERIFY(lamp != no_patch);
    const Scene& scene = *shown.window->snapshot()->loaded->scene;
    edits.set_exitance(MaterialEdits::target_of(scene, TargetKind::material, lamp), {0, 0, 40});
    QVERIFY(wait_for([&] { return shown.window->snapshot()->materials != nullptr; }));
    QVERIFY(shown.scene_view->sharp().isNull());
    QVERIFY(shown.becomes_sharp());
    const QImage sharp = shown.scene_view->sharp();
    const QColor middle = sharp.pixelColor(sharp.rect().center());
    QVERIFY(middle.blue() > middle.red());
    QCOMPARE(compare(sharp, ShownLight(shown.subject())).different, 0);
  }

  void it_is_switched_by_its_key() {
    const SharpWindow& shown = common();
    QVERIFY(shown.becomes_sharp());
    shown.window->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(shown.window.get()));
    QTest::keyClick(shown.window.get(), Qt::Key_S);
    QVERIFY(!shown.sharp->action()->isChecked());
    QVERIFY(shown.scene_view->sharp().isNull());
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(fraction_in_own_color(*shown.scene_view, shown.window->colors) > 0.95);
    // While it is on, patches are smooth before any picture is there; the numbers stay.
    ColorChoice& colors = shown.window->colors;
    QVERIFY(!colors.is_fitted() && shown.window->snapshot()->linear_terms.empty());
    const ShownLight light(shown.subject());
    const double of_patches = mean_difference(shown.scene_view->picture(1), light);
    colors.set_fitted(true);
    const double of_fitted = mean_difference(shown.scene_view->picture(1), light);
    QVERIFY2(of_fitted < 0.75 * of_patches,
             qPrintable(QString("%1 of %2").arg(of_fitted).arg(of_patches)));
    QVERIFY(colors.values() == shown.window->snapshot()->radiosity);
    colors.set_fitted(false);
    QTest::keyClick(shown.window.get(), Qt::Key_S);
    QVERIFY(shown.becomes_sharp() && colors.is_fitted());
  }

  void it_is_switched_by_its_button() {
    const SharpWindow& shown = common();
    QVERIFY(shown.becomes_sharp());
    auto* button = shown.window->findChild<QToolButton*>("sharp_button");
    QVERIFY(button->isVisible() && button->isChecked());
    QVERIFY2(button->toolTip().contains("(S)"), qPrintable(button->toolTip()));
    button->click();
    QVERIFY(!button->isChecked() && shown.scene_view->sharp().isNull());
    button->click();
    QVERIFY(shown.becomes_sharp());
  }

  void other_quantities_and_edges_are_not_covered() {
    const SharpWindow& shown = common();
    QVERIFY(shown.becomes_sharp());
    ColorChoice& colors = shown.window->colors;
    const auto none = [&] {
      return shown.scene_view->sharp().isNull() && shown.sharp->settled() &&
             shown.window->findChild<QLabel*>("sharp_label")->isHidden();
    };
    colors.set_quantity(Quantity::irradiance);
    QVERIFY(wait_for(none) && !colors.is_fitted());
    colors.set_quantity(Quantity::radiosity);
    QVERIFY(shown.becomes_sharp());
    colors.set_mode(ColorMode::luminance);
    QVERIFY(wait_for(none));
    colors.set_mode(ColorMode::true_color);
    shown.scene_view->set_outlines_shown(true);
    QVERIFY(wait_for(none) && !colors.is_fitted());
    shown.scene_view->set_outlines_shown(false);
    shown.scene_view->set_wireframe(true);
    QVERIFY(wait_for(none));
    shown.scene_view->set_wireframe(false);
    colors.set_quantity(Quantity::eye_radiance);
    QVERIFY(shown.becomes_sharp());
    colors.set_quantity(Quantity::radiosity);
  }

  void the_selection_is_drawn_over_it() {
    const SharpWindow& shown = common();
    QVERIFY(shown.becomes_sharp());
    const QImage before = shown.scene_view->picture(1);
    const QPoint middle = shown.scene_view->canvas()->rect().center();
    shown.window->selection.select(shown.scene_view->patch_at(middle));
    QVERIFY(!shown.scene_view->sharp().isNull());
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(different_pixels(before, shown.scene_view->picture(1)) > 50);
    shown.window->selection.select(no_patch);
    QVERIFY(comes_to_rest(*shown.window));
    QCOMPARE(shown.scene_view->picture(1), before);
  }

  void what_is_hidden_or_clipped_is_seen_through() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    const QPoint middle = shown.scene_view->canvas()->rect().center();
    const QColor before = shown.scene_view->sharp().pixelColor(middle);
    const PatchId front = shown.scene_view->patch_at(middle);
    const PatchId hidden[] = {front};
    shown.window->views().page.hidden().hide(hidden);
    QVERIFY(wait_for([&] { return shown.scene_view->sharp().isNull(); }));
    QVERIFY(shown.becomes_sharp());
    QVERIFY(shown.scene_view->patch_at(middle) != front);
    QVERIFY(difference(shown.scene_view->sharp().pixelColor(middle), before) > 3);
    shown.window->views().page.hidden().show_all();
    shown.scene_view->set_clip(ClipPlane{ClipPlane::Axis::x, 0.5, false});
    QVERIFY(shown.becomes_sharp());
    const QImage clipped = shown.scene_view->sharp();
    int background = 0;
    for (int y = 5; y < clipped.height(); y += 10) {
      for (int x = 5; x < clipped.width(); x += 10) {
        const bool is_empty = shown.scene_view->patch_at({x, y}) == no_patch;
        background += is_empty && difference(clipped.pixelColor(x, y), theme::scene_background) > 1;
      }
    }
    QVERIFY(background < 10);  // pixels at edges
  }

  void an_eye_inside_a_solid_is_told() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    const auto* label = shown.window->findChild<QLabel*>("sharp_label");
    QVERIFY(label->isHidden());
    const ViewPoint outside = shown.scene_view->view_point();
    ViewPoint inside = outside;
    inside.eye = {0.185, 0.08, 0.169};  // in the low block
    shown.scene_view->set_view_point(inside);
    QVERIFY(shown.becomes_sharp());
    QVERIFY(label->isVisible());
    QVERIFY2(label->text().contains("inside a solid"), qPrintable(label->text()));
    // Its backs are transparent, as on the surfaces.
    const Compared compared = compare(shown.scene_view->sharp(), ShownLight(shown.subject()));
    QVERIFY2(compared.pixels > 100, qPrintable(QString::number(compared.pixels)));
    QCOMPARE(compared.different, 0);
    save_picture(*shown.window, "sharp-inside");
    shown.scene_view->set_view_point(outside);
    QVERIFY(shown.becomes_sharp());
    QVERIFY(label->isHidden());
  }

  void a_change_ends_the_picture_that_is_saved_with_a_message() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    QTimer::singleShot(0, shown.window.get(), [&] {
      shown.window->relighting.edits().set_reflectance("material:white", {0.3, 0.3, 0.3});
    });
    QVERIFY(!shown.sharp->make(8 * shown.subject().size, shown.window.get()));
    const QString text = shown.window->banner_text();
    QVERIFY2(text.contains("has changed: the picture was not made"), qPrintable(text));
    QVERIFY(shown.becomes_sharp());
  }

  void a_picture_that_is_saved_is_sharp_at_its_size() {
    const SharpWindow shown;
    QVERIFY(shown.becomes_sharp());
    const auto large = shown.sharp->make(2 * shown.subject().size, shown.window.get());
    QVERIFY(large.has_value());
    QCOMPARE(large->size(), 2 * shown.scene_view->sharp().size());
    SharpSubject subject = shown.subject();
    subject.size *= 2;
    QCOMPARE(compare(*large, ShownLight(subject)).different, 0);
    shown.scene_view->set_antialiased(false);
    const QImage picture = shown.scene_view->picture({.size = subject.size, .sharp = *large});
    QCOMPARE(different_pixels(picture.convertToFormat(QImage::Format_RGB32),
                              large->convertToFormat(QImage::Format_RGB32)),
             0);
    QVERIFY(shown.scene_view->sharp().size() == shown.subject().size);
    // Without a sharp picture, the surfaces are saved.
    shown.sharp->action()->setChecked(false);
    const auto none = shown.sharp->make({300, 200}, shown.window.get());
    QVERIFY(none && none->isNull());
  }

 private:
  /// One window for the tests that leave it as it was: its light takes 20 s of a processor.
  const SharpWindow& common() {
    if (!common_) {
      common_ = std::make_unique<SharpWindow>();
    }
    return *common_;
  }

  std::unique_ptr<SharpWindow> common_;
};

const test::Registered registered("sharp", test::run_as_viewer<SharpTest>);

}  // namespace transillum::viewer::sharp_test

#include "sharp_test.moc"

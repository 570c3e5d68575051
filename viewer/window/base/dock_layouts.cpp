// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/dock_layouts.h"

#include <QChildEvent>
#include <QDockWidget>
#include <QMenu>
#include <QResizeEvent>
#include <QSettings>
#include <QTabBar>
#include <QTimer>
#include <algorithm>
#include <optional>
#include <utility>

#include "support/checked_bytes.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"
#include "window/base/unpainted.h"

namespace transillum::viewer {

namespace {

// Raise this number when docks are added, removed or renamed: older saved layouts then become
// invalid.
constexpr int layout_version = 13;

// More tabs would hide each other's names.
constexpr int most_tabs = 4;

// The map takes this fraction of the window's width in the layout to step.
constexpr double map_fraction = 0.735;

struct Widths {
  int left, right;
};
Widths usual_widths_of(Layout layout) {
  return layout == Layout::teach ? Widths{400, 480} : Widths{290, 360};
}

// A larger font needs wider sides, but the scene must keep enough width.
Widths widths_of(Layout layout, int window_width) {
  if (layout == Layout::debug) {
    return {static_cast<int>(map_fraction * window_width), 0};
  }
  constexpr double most_fraction = 0.64;
  const Widths usual = usual_widths_of(layout);
  const double sum = usual.left + usual.right;
  const double factor = std::clamp(most_fraction * window_width / sum, 1.0, theme::scale());
  return {static_cast<int>(factor * usual.left), static_cast<int>(factor * usual.right)};
}

}  // namespace

DockLayouts::DockLayouts(QMainWindow& window) : QObject(&window), window_(window) {
  window_.setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowNestedDocks |
                         QMainWindow::AllowTabbedDocks);
  window_.setCorner(Qt::TopLeftCorner, Qt::LeftDockWidgetArea);
  window_.setCorner(Qt::TopRightCorner, Qt::RightDockWidgetArea);
  window_.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  window_.setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  window_.installEventFilter(this);
  panel_menu_ = named("panels", new QMenu(tr("Panels"), &window_));
  make_actions();
}

void DockLayouts::make_actions() {
  const auto add = [this](Layout layout, const char* name, const QString& text, const char* key,
                          const QString& tip) {
    QAction* action = at(actions_, layout) = make_key_action(
        this, QString::fromLatin1(name), text, tip, QKeySequence(QString::fromLatin1(key)));
    action->setCheckable(true);
    connect(action, &QAction::triggered, this, [this, layout] {
      choose(layout);
      show_state();
      emit chosen(layout);
    });
  };
  add(Layout::teach, "layout_teach", tr("Teach"), "Ctrl+1",
      tr("Lessons with questions, on a screen or a projector"));
  add(Layout::inspect, "layout_inspect", tr("Inspect"), "Ctrl+2",
      tr("A scene: what lights a patch, how large the error is"));
  add(Layout::debug, "layout_debug", tr("Step"), "Ctrl+3",
      tr("One direction, polygon by polygon, forward and back"));
  swap_ = make_key_action(this, "swap_views", tr("Scene and map change places"),
                          tr("Give the scene the room of the map, and the map that of the scene"),
                          Qt::Key_V);
  connect(swap_, &QAction::triggered, this, &DockLayouts::swap_views);
  show_state();
}

void DockLayouts::swap_views() {
  if (held_ || covered_ || current_ != Layout::debug) {
    return;
  }
  show_alone({});
  bring_to_front("map");
  scene_large_ = find("map")->widget->width() > window_.width() / 2;
  arrange_sizes();
}

void DockLayouts::show_state() {
  enable_if(*swap_, !covered_ && current_ == Layout::debug,
            tr("Only where directions are stepped"));
  for (int k = 0; k < layout_count; ++k) {
    at(actions_, k)->setChecked(!covered_ && static_cast<Layout>(k) == current_);
  }
}

QDockWidget* DockLayouts::add(const QString& title, const char* name, QWidget* content) {
  auto* dock = named(name, new QDockWidget(title, &window_));
  dock->setWidget(content);
  // Otherwise a column would become wider when its content does, and the scene would move.
  constexpr int least_width = 200;
  content->setMinimumWidth(least_width);
  // Qt moves a tab behind others off screen but reports it as visible: its content would continue
  // to work, and would not be notified when it comes to the front. Without the next lines, a dock
  // with hidden content gets no space, nor do its neighbors.
  QSizePolicy policy = content->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  content->setSizePolicy(policy);
  connect(dock, &QDockWidget::visibilityChanged, this, [this, dock, content](bool visible) {
    content->setVisible(visible || dock->isHidden());
    if (visible) {
      fronts_.erase(std::remove(fronts_.begin(), fronts_.end(), dock), fronts_.end());
      fronts_.push_back(dock);
    }
  });
  connect(dock->toggleViewAction(), &QAction::triggered, this, [this, dock](bool shown) {
    if (shown) {
      dock->raise();
      follow_type();
      limit_tabs(dock);
    }
  });
  // A floating panel stays above the window, and can be maximized.
  connect(dock, &QDockWidget::topLevelChanged, dock, [dock](bool floating) {
    if (floating) {
      dock->setWindowFlags(Qt::Tool | Qt::CustomizeWindowHint | Qt::WindowTitleHint |
                           Qt::WindowSystemMenuHint | Qt::WindowMinMaxButtonsHint |
                           Qt::WindowCloseButtonHint);
      dock->show();
    }
  });
  dock->installEventFilter(this);
  panel_menu_->addAction(dock->toggleViewAction());
  docks_.push_back({dock, dock->objectName().remove(QStringLiteral("_dock")).toStdString()});
  return dock;
}

const DockLayouts::Dock* DockLayouts::find(const std::string& panel) const {
  const auto found = std::find_if(docks_.begin(), docks_.end(),
                                  [&](const Dock& dock) { return dock.panel == panel; });
  return found == docks_.end() ? nullptr : &*found;
}

const DockPlace* DockLayouts::place_of(const Dock& dock) const {
  for (const DockPlace& place : dock_places_of(dock.panel)) {
    if (place.layout == current_) {
      return &place;
    }
  }
  return nullptr;
}

void DockLayouts::choose(Layout layout) {
  if (held_) {
    return;
  }
  const Unpainted unpainted(window_);
  uncover();
  if (layout == current_) {
    show_alone({});
    return;
  }
  at(kept_, current_) = plain_state();
  arrange(layout);
  if (const QByteArray& kept = at(kept_, layout); !kept.isEmpty()) {
    window_.restoreState(kept, layout_version);
  }
}

void DockLayouts::reset() {
  if (!held_) {
    uncover();
    arrange(current_);
  }
}

void DockLayouts::arrange(Layout layout) {
  const Unpainted unpainted(window_);
  uncover();
  current_ = layout;
  scene_large_ = false;
  emit switched();
  end_alone();
  for (const Dock& dock : docks_) {
    // In this order: a dock that has been removed does not come back from floating.
    dock.widget->setFloating(false);
    window_.removeDockWidget(dock.widget);
  }
  stacks_.clear();
  for (const Dock& dock : docks_) {
    dock.widget->hide();
    if (const DockPlace* place = place_of(dock)) {
      this->place(dock, *place);
    }
  }
  place_others();
  arrange_sizes();
  enlarged_ = false;
  // Qt may leave an empty tab bar.
  QTimer::singleShot(0, this, [this] {
    for (QTabBar* bar : window_.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
      if (bar->count() == 0) {
        bar->hide();
      }
    }
  });
  show_state();
  emit switched();
}

void DockLayouts::place(const Dock& dock, const DockPlace& place) {
  window_.addDockWidget(place.area, dock.widget);
  QDockWidget*& first = stacks_[{place.area, place.stack}];
  if (first) {
    window_.tabifyDockWidget(first, dock.widget);
  } else {
    first = dock.widget;
  }
  dock.widget->setVisible(place.opening != DockPlace::Opening::closed);
  if (place.opening == DockPlace::Opening::behind) {
    first->raise();
  }
}

// Docks without a place in this layout open as tabs: beside the other docks, they would make the
// window higher than small screens.
void DockLayouts::place_others() {
  const Qt::DockWidgetArea area =
      current_ == Layout::debug ? Qt::TopDockWidgetArea : Qt::RightDockWidgetArea;
  const int stack = current_ == Layout::debug ? 1 : 2;
  for (const Dock& dock : docks_) {
    if (!place_of(dock)) {
      place(dock, {current_, area, stack, 0});
    }
  }
}

void DockLayouts::limit_tabs(QDockWidget* shown) {
  QList<QDockWidget*> tabs = window_.tabifiedDockWidgets(shown);
  tabs.erase(std::remove_if(tabs.begin(), tabs.end(),
                            [](const QDockWidget* tab) { return tab->isHidden(); }),
             tabs.end());
  const auto age = [this](QDockWidget* tab) {
    return std::find(fronts_.begin(), fronts_.end(), tab) - fronts_.begin();
  };
  // A tab that was never in front is the first to go.
  const auto order = [&](QDockWidget* tab) {
    return age(tab) == std::ssize(fronts_) ? -1 : age(tab);
  };
  while (tabs.size() >= most_tabs) {
    const auto oldest = std::min_element(tabs.begin(), tabs.end(),
                                         [&](auto* a, auto* b) { return order(a) < order(b); });
    (*oldest)->hide();
    tabs.erase(oldest);
  }
}

void DockLayouts::arrange_sizes() {
  constexpr double usual_height = 1000;
  QList<QDockWidget*> shown;
  QList<int> heights;
  for (const Dock& dock : docks_) {
    const DockPlace* place = place_of(dock);
    if (place && !dock.widget->isHidden()) {
      shown << dock.widget;
      // The scene below the panels at the top needs room in a low window, too.
      const double part =
          (scene_large_ ? 0.55 : 1.0) * std::min(1.0, window_.height() / usual_height);
      heights << (place->area == Qt::TopDockWidgetArea ? static_cast<int>(part * place->height)
                                                       : place->height);
    }
  }
  window_.resizeDocks(shown, heights, Qt::Vertical);
  follow_type();
}

void DockLayouts::follow_type() {
  if (held_) {
    return;  // a full screen has other widths
  }
  Widths widths = widths_of(current_, window_.width());
  if (scene_large_) {
    widths.left = window_.width() - widths.left;
  }
  QList<QDockWidget*> columns;
  QList<int> across;
  for (const Dock& dock : docks_) {
    const Qt::DockWidgetArea area = window_.dockWidgetArea(dock.widget);
    const bool beside = area == Qt::LeftDockWidgetArea || area == Qt::RightDockWidgetArea;
    if (beside && !dock.widget->isHidden() && !dock.widget->isFloating()) {
      columns << dock.widget;
      across << (area == Qt::LeftDockWidgetArea ? widths.left : widths.right);
    }
  }
  window_.resizeDocks(columns, across, Qt::Horizontal);  // at once: each call arranges the window
  fit_bottom();
}

// Where the map takes a fraction of the window, it keeps that when the window changes.
void DockLayouts::keep_fraction(int width_before) {
  const Dock* map = find("map");
  if (current_ == Layout::debug && map && !map->widget->isHidden() && !covered_ && !held_ &&
      alone_.isEmpty()) {
    const double fraction = 1.0 * map->widget->width() / width_before;
    window_.resizeDocks({map->widget}, {static_cast<int>(fraction * window_.width())},
                        Qt::Horizontal);
  }
}

void DockLayouts::fit_bottom() {
  constexpr double fraction = 0.17, most_fraction = 0.24;
  for (const Dock& dock : docks_) {
    const DockPlace* place = place_of(dock);
    if (!place || place->area != Qt::BottomDockWidgetArea || dock.widget->isHidden()) {
      continue;
    }
    const double usual = std::min(theme::scale() * place->height, fraction * window_.height());
    // In a low window, the panels above need the room more.
    const double wanted = dock.widget->widget()->sizeHint().height();
    const bool has_room = wanted < most_fraction * window_.height();
    window_.resizeDocks({dock.widget},
                        {static_cast<int>(has_room ? std::max(usual, wanted) : usual)},
                        Qt::Vertical);
  }
}

bool DockLayouts::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ChildPolished) {
    // The window creates the tab bars of its docks; all tabs must be visible.
    auto* bar = qobject_cast<QTabBar*>(static_cast<QChildEvent*>(event)->child());
    if (bar) {
      bar->setElideMode(Qt::ElideRight);
      bar->setUsesScrollButtons(false);
    }
  }
  const bool moves = event->type() == QEvent::Resize || event->type() == QEvent::Move;
  if (watched == &window_ && event->type() == QEvent::Resize) {
    const int before = static_cast<QResizeEvent*>(event)->oldSize().width();
    if (before > 0 && before != window_.width()) {
      keep_fraction(before);
    }
  }
  if (moves || event->type() == QEvent::LayoutRequest) {
    QTimer::singleShot(0, this, &DockLayouts::repaint_moved);
  }
  return QObject::eventFilter(watched, event);
}

void DockLayouts::repaint_moved() {
  std::vector<QRect> places;
  for (const Dock& dock : docks_) {
    places.push_back(dock.widget->isVisible() ? dock.widget->geometry() : QRect());
  }
  if (places != places_) {
    places_ = std::move(places);
    window_.update();
  }
}

void DockLayouts::hold(bool held) {
  if (held && !held_) {
    held_state_ = state();
  }
  held_ = held;
  if (!held_ && std::exchange(uncovers_later_, false)) {
    window_.restoreState(covered_state_, layout_version);
  }
}

void DockLayouts::cover(bool covered) {
  const Unpainted unpainted(window_);
  if (!covered) {
    uncover();
    return;
  }
  if (covered_ || held_) {
    return;
  }
  covered_state_ = plain_state();
  end_alone();
  covered_ = true;
  for (const Dock& dock : docks_) {
    if (!dock.widget->isFloating()) {
      dock.widget->hide();
    }
  }
  enable_if(*panel_menu_->menuAction(), false, tr("The first page covers the panels"));
  show_state();
  emit switched();
}

void DockLayouts::uncover() {
  if (!std::exchange(covered_, false)) {
    return;
  }
  enable_if(*panel_menu_->menuAction(), true, {});
  if (held_) {
    uncovers_later_ = true;
  } else {
    window_.restoreState(covered_state_, layout_version);
  }
  show_state();
  emit uncovered();
  emit switched();
}

QByteArray DockLayouts::state() const { return held_ ? held_state_ : with_checksum(plain_state()); }

QByteArray DockLayouts::plain_state() const {
  if (covered_ || uncovers_later_) {
    return covered_state_;
  }
  return alone_.isEmpty() ? window_.saveState(layout_version) : before_alone_;
}

bool DockLayouts::restore(int layout, const QByteArray& state) {
  const Unpainted unpainted(window_);
  const std::optional<QByteArray> checked = without_checksum(state);
  if (layout < 0 || layout >= layout_count || !checked) {
    return false;
  }
  if (held_) {
    return true;
  }
  arrange(static_cast<Layout>(layout));
  return window_.restoreState(*checked, layout_version);
}

namespace {

QString key_of(int layout) { return QStringLiteral("window/kept/%1").arg(layout); }

}  // namespace

void DockLayouts::save(QSettings& settings) const {
  settings.setValue("window/state", state());
  settings.setValue("window/layout", static_cast<int>(current_));
  for (int k = 0; k < layout_count; ++k) {
    settings.setValue(key_of(k), with_checksum(at(kept_, k)));
  }
}

bool DockLayouts::load(const QSettings& settings) {
  for (int k = 0; k < layout_count; ++k) {
    at(kept_, k) = without_checksum(settings.value(key_of(k)).toByteArray()).value_or(QByteArray());
  }
  return restore(settings.value("window/layout", -1).toInt(),
                 settings.value("window/state").toByteArray());
}

void DockLayouts::add_to(QMenu& menu) {
  for (QAction* action : actions_) {
    menu.addAction(action);
  }
  menu.addAction(swap_);
  menu.addAction(tr("Reset the layout"), this, &DockLayouts::reset,
                 QKeySequence(QStringLiteral("Ctrl+0")))
      ->setObjectName("layout_reset");
  menu.addMenu(panel_menu_);
}

bool DockLayouts::bring_to_front(const std::string& panel) {
  const Dock* dock = find(panel);
  if (dock && !held_) {
    uncover();
    const bool hidden = dock->widget->isHidden();
    dock->widget->show();
    dock->widget->raise();
    if (hidden) {
      follow_type();
      limit_tabs(dock->widget);
    }
  }
  return dock != nullptr;
}

void DockLayouts::show_for_page(const std::vector<std::string>& panels) {
  if (held_) {
    return;
  }
  const Unpainted unpainted(window_);
  uncover();
  for (const Dock& dock : docks_) {
    const bool named = std::find(panels.begin(), panels.end(), dock.panel) != panels.end();
    if (current_ == Layout::teach && place_of(dock) && !named && dock.panel != "lesson") {
      dock.widget->hide();
    }
  }
  bring_to_front("lesson");
  for (const std::string& panel : panels) {
    bring_to_front(panel);
  }
  if (current_ != Layout::teach) {
    return;
  }
  arrange_sizes();
  // Once more when panels that were hidden have got a place.
  QTimer::singleShot(0, this, [this] {
    if (current_ == Layout::teach && !enlarged_ && !held_ && !covered_ && alone_.isEmpty()) {
      arrange_sizes();
    }
  });
}

void DockLayouts::end_alone() {
  if (!alone_.isEmpty()) {
    alone_.clear();
    emit alone({});
  }
}

void DockLayouts::show_alone(const std::string& panel) {
  const Unpainted unpainted(window_);
  const QString name = QString::fromStdString(panel);
  if (held_ || name == alone_) {
    emit alone(alone_);
    return;
  }
  if (!alone_.isEmpty()) {
    end_alone();
    window_.restoreState(before_alone_, layout_version);
  }
  const Dock* found = find(panel);
  if (!found) {
    return;
  }
  uncover();
  before_alone_ = window_.saveState(layout_version);
  alone_ = name;
  for (const Dock& dock : docks_) {
    const bool bottom = window_.dockWidgetArea(dock.widget) == Qt::BottomDockWidgetArea;
    if (dock.widget != found->widget && !bottom && !dock.widget->isFloating()) {
      dock.widget->hide();
    }
  }
  bring_to_front(panel);
  constexpr double fraction = 0.62;  // the scene needs less width than it has beside two columns of
                                     // panels
  window_.resizeDocks({found->widget}, {static_cast<int>(fraction * window_.width())},
                      Qt::Horizontal);
  emit alone(alone_);
}

void DockLayouts::enlarge(const std::string& panel) {
  if (held_) {
    return;
  }
  const Unpainted unpainted(window_);
  show_alone({});
  if (enlarged_) {
    arrange_sizes();
    enlarged_ = false;
  }
  if (panel.empty()) {
    return;
  }
  enlarged_ = true;
  constexpr double wide = 0.42, high = 0.75, narrow = 0.16;
  if (const Dock* found = find(panel)) {
    bring_to_front(panel);
    window_.resizeDocks({found->widget}, {static_cast<int>(wide * window_.width())},
                        Qt::Horizontal);
    window_.resizeDocks({found->widget}, {static_cast<int>(high * window_.height())}, Qt::Vertical);
    return;
  }
  for (const Dock& dock : docks_) {
    if (window_.dockWidgetArea(dock.widget) == Qt::RightDockWidgetArea &&
        !dock.widget->isHidden()) {
      window_.resizeDocks({dock.widget}, {static_cast<int>(narrow * window_.width())},
                          Qt::Horizontal);
    }
  }
}

std::vector<std::string> DockLayouts::panels() const {
  std::vector<std::string> names;
  for (const Dock& dock : docks_) {
    names.push_back(dock.panel);
  }
  return names;
}

}  // namespace transillum::viewer

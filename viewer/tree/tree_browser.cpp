// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The outline view of the whole BSP tree, on TreeModel; expands the path to the current fragment.
#include "tree/tree_browser.h"

#include <QEvent>
#include <QHeaderView>
#include <QTreeView>
#include <algorithm>

#include "tree/order_bar.h"
#include "tree/tree_outline.h"
#include "tree/tree_tables.h"
#include "widgets/build.h"

namespace transillum::viewer {

TreeBrowser::TreeBrowser(Focus& focus, Selection& selection, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection) {
  model_ = new TreeModel(this);
  view_ = named("tree_browser", new QTreeView);
  view_->setModel(model_);
  view_->setFrameShape(QFrame::NoFrame);
  view_->setUniformRowHeights(true);
  view_->setAlternatingRowColors(true);
  view_->setExpandsOnDoubleClick(false);
  view_->setIndentation(10);
  view_->setMinimumHeight(60);
  view_->header()->setStretchLastSection(false);
  view_->header()->setSectionResizeMode(TreeModel::of_order, QHeaderView::Stretch);
  view_->setItemDelegateForColumn(TreeModel::of_order, new OrderBar(focus_, selection_, this));

  auto* layout = make_column(this, {});
  layout->addWidget(view_);
  connect(view_, &QTreeView::clicked, this, [this](const QModelIndex& index) {
    const PatchId patch = patch_of(model_->outline(), model_->visit(index));
    if (index.column() != TreeModel::of_order && patch != no_patch) {
      selection_.select(patch);
    }
  });
  connect(view_, &QTreeView::doubleClicked, this, [this](const QModelIndex& index) {
    const TreeVisit& visit = model_->visit(index);
    // A free plane holds no fragment: go to the first fragment of its far side.
    if (index.column() != TreeModel::of_order) {
      focus_.go_to_step(visit.plane_begin < visit.end ? visit.plane_begin : visit.begin);
    }
  });
  connect(&selection_, &Selection::changed, view_->viewport(), qOverload<>(&QWidget::update));
  set_widths();
}

void TreeBrowser::show_position(const std::shared_ptr<const TreeOutline>& outline) {
  outline_ = outline;
  if (!isVisible()) {
    return;
  }
  const auto map = focus_.map();
  if (!map || !outline) {
    model_->show_position(nullptr, {}, -1);
    opened_.clear();
    return;
  }
  model_->show_position(outline, map->record().frame.omega, std::max(focus_.position().step, 0));
  open_path();
  view_->viewport()->update();
}

void TreeBrowser::open_path() {
  // Collapse what an earlier path expanded, but not what the user expanded.
  const std::vector<std::int32_t>& path = model_->path();
  const auto changed =
      std::mismatch(opened_.begin(), opened_.end(), path.begin(), path.end()).first;
  for (auto node = opened_.end(); node != changed; --node) {
    view_->collapse(model_->index_of(*std::prev(node)));
  }
  opened_.erase(changed, opened_.end());
  for (const std::int32_t node : path) {
    const QModelIndex index = model_->index_of(node);
    if (node == path.back() || view_->isExpanded(index)) {
      continue;
    }
    view_->expand(index);
    opened_.push_back(node);
  }
  if (!path.empty()) {
    view_->scrollTo(model_->index_of(path.back()));
  }
}

void TreeBrowser::set_widths() {
  const auto advance = [this](const char* text) { return fontMetrics().horizontalAdvance(text); };
  view_->header()->resizeSection(TreeModel::of_plane, advance("patch 88888 + 8") + 150);
  view_->header()->resizeSection(TreeModel::of_side, advance("front, first") + 14);
  view_->header()->resizeSection(TreeModel::of_count, advance("Fragments") + 14);
}

void TreeBrowser::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  show_position(outline_);
}

void TreeBrowser::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    set_widths();
  }
}

}  // namespace transillum::viewer

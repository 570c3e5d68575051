// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel of the BSP tree: a text, the path to the current fragment, and the whole tree. It
// follows the map in Focus.
#include "tree/tree_view.h"

#include <QHeaderView>
#include <QTabWidget>
#include <QTableView>
#include <algorithm>

#include "support/number_text.h"
#include "tree/order_bar.h"
#include "tree/tree_browser.h"
#include "tree/tree_outline.h"
#include "tree/tree_tables.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

TreeView::TreeView(Focus& focus, Selection& selection, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection) {
  text_ = named("tree_words", note_label({}, {10, 4, 10, 4}));
  make_path_table();
  auto* layout = make_column(this, {}, 0);
  layout->addWidget(text_);
  browser_ = new TreeBrowser(focus_, selection_);
  tabs_ = named("tree_tabs", new QTabWidget);
  tabs_->setDocumentMode(true);
  tabs_->addTab(table_, tr("Path to the fragment"));
  tabs_->addTab(browser_, tr("Whole tree"));
  layout->addWidget(tabs_, 1);
  connect(&focus_, &Focus::moved, this, &TreeView::show_position);
  connect(&selection_, &Selection::changed, this, [this] {
    show_text();
    table_->viewport()->update();
  });
  show_position();
}

void TreeView::make_path_table() {
  path_ = new TreePathTable(this);
  table_ = named("tree_path", new QTableView);
  table_->setModel(path_);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setFocusPolicy(Qt::NoFocus);
  table_->horizontalHeader()->setSectionResizeMode(TreePathTable::of_order, QHeaderView::Stretch);
  set_up_value_table(*table_, {"patch 888 + 8", "−0.888", "before: front", "", "88 888"});
  table_->setItemDelegateForColumn(TreePathTable::of_order, new OrderBar(focus_, selection_, this));

  const auto patch_at = [this](const QModelIndex& index) {
    return patch_of(path_->outline(), path_->visit(index.row()));
  };
  const auto in_plane = [patch_at](const QModelIndex& index) {
    return index.column() != TreePathTable::of_order && patch_at(index) != no_patch;
  };
  connect(table_, &QTableView::clicked, this, [this, in_plane, patch_at](const QModelIndex& index) {
    if (in_plane(index)) {
      selection_.select(patch_at(index));
    }
  });
  connect(table_, &QTableView::doubleClicked, this, [this, in_plane](const QModelIndex& index) {
    if (in_plane(index)) {
      focus_.go_to_step(path_->visit(index.row()).plane_begin);
    }
  });
}

void TreeView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  show_position();
}

void TreeView::show_position() {
  if (!isVisible()) {
    return;
  }
  const auto map = focus_.map();
  if (!map) {
    outline_ = nullptr;
    path_->show_path(nullptr, {}, -1);
  } else {
    if (!outline_ || &outline_->tree() != map->loaded->tree.get()) {
      outline_ = std::make_shared<const TreeOutline>(map->loaded->tree);
    }
    // Before the first step, the path to its fragment is shown.
    const std::int32_t step = std::max(focus_.position().step, 0);
    path_->show_path(outline_, outline_->path_to(step, map->record().frame.omega), step);
    table_->scrollToBottom();
    table_->viewport()->update();
  }
  browser_->show_position(outline_);
  show_text();
}

void TreeView::show_text() {
  const auto map = focus_.map();
  const int rows = path_->rowCount();
  if (!map || rows == 0) {
    text_->setText(tr("The planes that order the fragments appear after the first direction."));
    return;
  }
  const std::int32_t step = path_->step();
  text_->setText(
      tr("Path to the fragment of step %1 (patch %2). At each plane, the side that ω points "
         "to comes first. %3")
          .arg(count_text(step + 1))
          .arg(map->history.step(step).patch)
          .arg(text_of_selection()));
}

QString TreeView::text_of_selection() const {
  const auto map = focus_.map();
  const PatchId patch = selection_.patch();
  const MapHistory& history = map->history;
  if (patch == no_patch || history.step(path_->step()).patch == patch) {
    return {};
  }
  const auto steps = history.steps_of(patch);
  const auto own = std::find_if(steps.begin(), steps.end(),
                                [&](std::int32_t k) { return history.step(k).patch == patch; });
  if (own == steps.end()) {
    return {};
  }
  // The lowest plane above both separates them.
  int row = path_->rowCount() - 1;
  while (row > 0 && !path_->visit(row).holds(*own)) {
    --row;
  }
  const QString when = *own < path_->step() ? tr("before") : tr("after");
  return tr("Patch %1 comes %2 it, separated by %3.")
      .arg(patch)
      .arg(when, plane_phrase(*outline_, path_->visit(row)));
}

}  // namespace transillum::viewer

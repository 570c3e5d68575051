// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Patches". Snapshots arrive often while a solve runs; the tables are refilled a few
// times a second at most, and only while the panel is visible.
#include "patches/patch_table_panel.h"

#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTableView>
#include <QTimer>
#include <utility>

#include "model/snapshot_values.h"
#include "patches/table_rows.h"
#include "support/number_text.h"
#include "transillum/files.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

constexpr int refresh_interval_ms = 400;
constexpr int fraction_column = 4;  // column of the table of partners

}  // namespace

PatchTablePanel::PatchTablePanel(Selection& selection, QWidget* parent)
    : QWidget(parent), selection_(selection), tabs_(new QTabWidget) {
  search_ = named("patch_search", new QLineEdit);
  search_->setPlaceholderText(tr("Patch number or material"));
  search_->setClearButtonEnabled(true);
  auto* export_button =
      named("export_table", new QPushButton(tr("Export…")), tr("Write the shown rows as CSV"));
  tabs_->setDocumentMode(true);
  all_ = add_page(tr("All patches"), "patch_table");
  partners_ = add_page(tr("Partners of selection"), "partner_table");
  partners_.view->sortByColumn(fraction_column, Qt::DescendingOrder);
  refresh_timer_ = new QTimer(this);
  refresh_timer_->setSingleShot(true);

  auto* row = make_row({10, 8, 10, 6});
  row->addWidget(search_, 1);
  row->addWidget(export_button);
  auto* layout = make_column(this, {}, 0);
  layout->addLayout(row);
  layout->addWidget(tabs_, 1);

  connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
    for (const TablePage& page : {all_, partners_}) {
      page.table->set_search(text.trimmed());
    }
    mark_selection();
    count_rows();
  });
  connect(search_, &QLineEdit::returnPressed, this, [this] {
    const PatchTable& table = *current().table;
    if (table.rowCount() == 0) {
      return;
    }
    // A number selects that patch, even where other numbers with the same prefix come first.
    bool is_number = false;
    const PatchId number = search_->text().trimmed().toInt(&is_number);
    selection_.select(is_number && table.row_of(number) >= 0 ? number : table.patch(0));
    search_->clear();  // a text would filter the table of partners too
  });
  connect(export_button, &QPushButton::clicked, this, &PatchTablePanel::choose_csv);
  connect(tabs_, &QTabWidget::currentChanged, this, &PatchTablePanel::refresh);
  connect(refresh_timer_, &QTimer::timeout, this, &PatchTablePanel::refresh);
  connect(&selection_, &Selection::changed, this, [this] {
    if (!watched_) {
      return;
    }
    if (current().table == partners_.table) {
      show_partners();
    }
    mark_selection();
  });
}

TablePage PatchTablePanel::add_page(const QString& title, const char* name) {
  const TablePage page = add_table_page(*tabs_, title, name, {});
  connect(page.view->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this, page](const QModelIndex& index) {
            // Does nothing in the table of partners: selecting another patch would replace its
            // contents.
            if (index.isValid() && page.view->hasFocus() && page.table == all_.table) {
              selection_.select(page.table->patch(index.row()));
            }
          });
  connect(page.view, &QTableView::clicked, this, [this, page](const QModelIndex& index) {
    if (page.table == all_.table) {
      selection_.select(page.table->patch(index.row()));
    }
  });
  connect(page.view, &QTableView::doubleClicked, this, [this, page](const QModelIndex& index) {
    selection_.select(page.table->patch(index.row()));
  });
  return page;
}

const TablePage& PatchTablePanel::current() const {
  return tabs_->currentIndex() == 0 ? all_ : partners_;
}

void PatchTablePanel::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  if (watched_ && !refresh_timer_->isActive()) {
    refresh_timer_->start(refresh_interval_ms);
  }
}

void PatchTablePanel::clear() {
  snapshot_ = nullptr;
  for (const TablePage& page : {all_, partners_}) {
    page.table->set_contents({}, {});
  }
  count_rows();
}

void PatchTablePanel::show_selected(bool partners) {
  search_->clear();
  tabs_->setCurrentIndex(partners ? 1 : 0);
  refresh();
}

void PatchTablePanel::begin_search() {
  search_->setFocus(Qt::ShortcutFocusReason);
  search_->selectAll();
}

void PatchTablePanel::set_watched(bool watched) {
  watched_ = watched;
  refresh();
}

void PatchTablePanel::refresh() {
  if (!watched_) {
    return;
  }
  if (current().table == partners_.table) {
    emit form_factors_requested();
    show_partners();
  } else if (snapshot_) {
    PatchRows rows = rows_of_all(*snapshot_);
    all_.table->set_contents(std::move(rows.patches), std::move(rows.columns));
  }
  mark_selection();
  count_rows();
}

void PatchTablePanel::show_partners() {
  const PatchId patch = selection_.patch();
  if (snapshot_ && patch != no_patch && snapshot_->form_factors) {
    PatchRows rows = rows_of_partners(*snapshot_, patch);
    partners_.table->set_contents(std::move(rows.patches), std::move(rows.columns));
  } else {
    partners_.table->set_contents({}, {});
  }
  count_rows();
}

void PatchTablePanel::mark_selection() {
  const TablePage& page = current();
  const int row = selection_.patch() == no_patch ? -1 : page.table->row_of(selection_.patch());
  if (row < 0) {
    page.view->clearSelection();
    return;
  }
  if (page.view->selectionModel()->isRowSelected(row, {})) {
    return;
  }
  page.view->selectionModel()->setCurrentIndex(
      page.table->index(row, 0), QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  page.view->scrollTo(page.table->index(row, 0));
}

void PatchTablePanel::count_rows() {
  const auto count = [](const PatchTable& table) {
    return table.rowCount() == table.size()
               ? tr("%1 patches").arg(count_text(table.size()))
               : tr("%1 of %2 patches").arg(count_text(table.rowCount()), count_text(table.size()));
  };
  all_.caption->setText(snapshot_ ? count(*all_.table) : tr("Open a scene to list its patches."));
  const PatchId patch = selection_.patch();
  if (!snapshot_ || patch == no_patch) {
    partners_.caption->setText(
        tr("Select a patch to list the patches that it exchanges light with."));
  } else if (!snapshot_->form_factors) {
    partners_.caption->setText(why_no_form_factors(*snapshot_));
  } else {
    partners_.caption->setText(
        tr("Patch i = %1 exchanges light with %2. Double-click a row to select its patch.")
            .arg(patch)
            .arg(count(*partners_.table)));
  }
}

void PatchTablePanel::write_csv(const QString& path) const {
  write_file_whole(path.toStdString(),
                   [this](std::ostream& out) { current().table->write_csv(out); });
}

void PatchTablePanel::choose_csv() {
  const QString path =
      ask_where_to_write(this, tr("Write the table"), tr("CSV (*.csv)"),
                         current().table == all_.table ? "patches.csv" : "partners.csv");
  if (path.isEmpty()) {
    return;
  }
  try {
    write_csv(path);
  } catch (const std::exception& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

}  // namespace transillum::viewer

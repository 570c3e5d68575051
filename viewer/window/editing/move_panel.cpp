// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/editing/move_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <cmath>

#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/setting_rows.h"
#include "window/editing/scene_edits.h"

namespace transillum::viewer {

namespace {

constexpr double angle_step = 15;           // degrees
constexpr double largest_coordinate = 1e6;  // m

/// 1, 2 or 5 times a power of ten, not above a value.
double round_step_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  return value >= 5 * power ? 5 * power : value >= 2 * power ? 2 * power : power;
}

}  // namespace

MovePanel::MovePanel(SceneEdits& edits, QWidget* parent) : QWidget(parent), edits_(edits) {
  setObjectName("move_panel");
  auto* rows = new SettingRows;
  reach_ = named("move_reach", new QComboBox);
  reach_->addItems({tr("Face"), tr("Object"), tr("Group"), tr("Lamp")});
  reach_->setCurrentIndex(static_cast<int>(edits_.reach()));
  rows->add(tr("Move the"), reach_,
            tr("The selected faces, or the object (faces that share edges), the group or the lamp "
               "that the selected patch belongs to"));
  note_ = note_label();
  rows->add(note_);
  numbers_ = new QWidget;
  auto* column = make_column(numbers_, {}, 0);
  auto* fields = new SettingRows;
  fields->add(tr("Center, m"), make_fields("move_center", center_),
              tr("The center of the target's box along x, y and z.\nIn the scene, the arrow keys "
                 "move the target in steps, Page Up and Page Down along the vertical"));
  fields->add(tr("Turn, °"), make_fields("move_turn", turn_),
              tr("Angles about x, then y, then z, since the target was chosen.\nIn the scene, "
                 "Shift with an arrow key turns it by 15°"));
  fields->add(tr("Scale"), make_fields("move_scale", scale_),
              tr("Factors along x, y and z, before the turn.\nIn the scene, + and − scale it by a "
                 "tenth"));
  column->addWidget(fields);
  step_ = named("move_step", new QDoubleSpinBox);
  step_->setDecimals(4);
  step_->setRange(1e-4, largest_coordinate);
  grid_ = named("move_grid", new QCheckBox(tr("Snap")),
                tr("Drags move in steps, and turn by 15°; the Ctrl key does the other"));
  auto* grid = new QWidget;
  auto* row = make_row(grid, {});
  row->addWidget(step_, 1);
  row->addWidget(grid_);
  fields->add(tr("Step, m"), grid, tr("The step of the grid and of the arrow keys"));

  auto* all = make_column(this, {12, 10, 12, 10}, 4);
  all->addWidget(rows);
  all->addWidget(numbers_);
  all->addWidget(make_buttons());
  all->addStretch(1);
  connect(reach_, qOverload<int>(&QComboBox::activated), this,
          [this](int index) { edits_.set_reach(static_cast<SceneEdits::Reach>(index)); });
  connect(&edits_, &SceneEdits::changed, this, &MovePanel::show_state);
  show_state();
}

QWidget* MovePanel::make_fields(const char* name, Fields& fields) {
  auto* widget = new QWidget;
  auto* row = make_row(widget, {}, 4);
  const bool turns = &fields == &turn_, scales = &fields == &scale_;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    auto* field = named(QStringLiteral("%1_%2").arg(QLatin1String(name)).arg(QChar('x' + int(k))),
                        new QDoubleSpinBox);
    field->setKeyboardTracking(false);
    field->setButtonSymbols(QAbstractSpinBox::NoButtons);
    field->setDecimals(turns ? 2 : 4);
    field->setRange(scales ? 1e-3 : -largest_coordinate, scales ? 1e3 : largest_coordinate);
    field->setSingleStep(turns ? angle_step : 0.1);
    field->setMinimumWidth(58);
    row->addWidget(field, 1);
    connect(field, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &MovePanel::place);
    fields[k] = field;
  }
  return widget;
}

QWidget* MovePanel::make_buttons() {
  copy_ = make_action(this, "copy_faces", tr("Copy the target"),
                      tr("Add a copy of what is edited beside it, with new face numbers"));
  connect(copy_, &QAction::triggered, &edits_, &SceneEdits::copy);
  remove_ = make_action(this, "remove_faces", tr("Remove the target"),
                        tr("Remove the faces; the others keep their numbers"));
  connect(remove_, &QAction::triggered, &edits_, &SceneEdits::remove);
  add_ = named("add_menu", new QMenu(tr("Add to the scene"), this));
  const auto add = [this](const char* name, const QString& text, AddedSolid solid) {
    QAction* action = add_->addAction(text, this, [this, solid] { edits_.add(solid); });
    action->setObjectName(QLatin1String(name));
  };
  add("add_box", tr("Box"), AddedSolid::box);
  add("add_board", tr("Board, two-sided"), AddedSolid::board);
  add("add_lamp", tr("Lamp, 10 W/m² downward"), AddedSolid::lamp);
  add("add_room", tr("Room around all"), AddedSolid::room);
  auto* buttons = new QWidget;
  auto* row = make_row(buttons, {});
  auto* copy = button_for(copy_);
  copy->setText(tr("Copy"));
  auto* remove = button_for(remove_);
  remove->setText(tr("Remove"));
  auto* adding = named("add_button", new QToolButton, tr("Add faces in the middle of the scene"));
  adding->setText(tr("Add"));
  adding->setMenu(add_);
  adding->setPopupMode(QToolButton::InstantPopup);
  for (QToolButton* button : {copy, remove, adding}) {
    row->addWidget(button);
  }
  row->addStretch(1);
  return buttons;
}

void MovePanel::add_to(QMenu& menu) const {
  menu.addActions({copy_, remove_});
  menu.addMenu(add_);
}

double MovePanel::step() const { return step_->value(); }

bool MovePanel::on_grid() const { return grid_->isChecked(); }

/// About a tenth of the target.
void MovePanel::choose_step() {
  const Vec3 extents = edits_.extents();
  if (extents == shown_extents_) {
    return;
  }
  shown_extents_ = extents;
  const double size = norm(extents);
  if (size > 0) {
    step_->setValue(round_step_below(size / 8));
    for (QDoubleSpinBox* field : center_) {
      field->setSingleStep(step_->value());
    }
  }
}

void MovePanel::show_state() {
  shows_ = true;
  const QString why = edits_.why_unavailable();
  const bool any = edits_.has_target();
  numbers_->setVisible(any && why.isEmpty());
  reach_->setCurrentIndex(static_cast<int>(edits_.reach()));
  enable_if(*reach_, why.isEmpty(), why);
  enable_if(*add_->menuAction(), why.isEmpty(), why);
  enable_if(*copy_, any, tr("Nothing is selected"));
  enable_if(*remove_, any, tr("Nothing is selected"));
  if (!why.isEmpty()) {
    note_->setText(why);
  } else if (!any) {
    note_->setText(tr("Select a patch in the scene."));
  } else {
    const Vec3 e = edits_.extents();
    const QString faces = edits_.face_count() == 1
                              ? tr("1 face")
                              : tr("%1 faces").arg(static_cast<qulonglong>(edits_.face_count()));
    note_->setText(
        tr("%1, %2 × %3 × %4 m").arg(faces, number_text(e.x), number_text(e.y), number_text(e.z)));
    choose_step();
    for (int k = 0; k < 3; ++k) {
      const auto set = [k](const Fields& fields, const Vec3& value) {
        fields[static_cast<std::size_t>(k)]->setValue(coordinate(value, k));
      };
      set(center_, edits_.center());
      set(turn_, edits_.placement().turn);
      set(scale_, edits_.placement().scale);
    }
  }
  shows_ = false;
}

/// Places the target by the numbers of the field that was changed: the others show rounded ones.
void MovePanel::place() {
  if (shows_ || !edits_.has_target()) {
    return;
  }
  FacePlacement placement = edits_.placement();
  for (int k = 0; k < 3; ++k) {
    const auto* changed = sender();
    const auto index = static_cast<std::size_t>(k);
    if (changed == center_[index]) {
      coordinate(placement.move, k) += center_[index]->value() - coordinate(edits_.center(), k);
    } else if (changed == turn_[index]) {
      coordinate(placement.turn, k) = turn_[index]->value();
    } else if (changed == scale_[index]) {
      coordinate(placement.scale, k) = scale_[index]->value();
    }
  }
  edits_.place(placement);
}

}  // namespace transillum::viewer

// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QUndoCommand>
#include <QUndoStack>
#include <functional>
#include <utility>

namespace transillum::viewer {

/// Undo command for a list of the user: the list before and after a change.
template <class List>
class ListChange : public QUndoCommand {
 public:
  using Set = std::function<void(const List&)>;

  ListChange(const QString& what, List before, List after, Set set)
      : QUndoCommand(what),
        before_(std::move(before)),
        after_(std::move(after)),
        set_(std::move(set)) {}
  void undo() override { set_(before_); }
  void redo() override { set_(after_); }

 private:
  List before_, after_;
  Set set_;
};

/// Replaces `before` by `after`; with `undo`, as an undoable command.
/// @param what  name of the change, shown as "Undo …"
template <class List>
void change_list(QUndoStack* undo, const QString& what, const List& before, List after,
                 typename ListChange<List>::Set set) {
  if (undo) {
    undo->push(new ListChange<List>(what, before, std::move(after), std::move(set)));
  } else {
    set(after);
  }
}

}  // namespace transillum::viewer

// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QUndoCommand>
#include <QUndoStack>
#include <functional>
#include <utility>

namespace transillum::viewer {

/// A short list of the user's before and after a change.
template <class List>
class ListChange : public QUndoCommand {
 public:
  using Put = std::function<void(const List&)>;

  ListChange(const QString& what, List before, List after, Put put)
      : QUndoCommand(what),
        before_(std::move(before)),
        after_(std::move(after)),
        put_(std::move(put)) {}
  void undo() override { put_(before_); }
  void redo() override { put_(after_); }

 private:
  List before_, after_;
  Put put_;
};

/// Puts `after` in the place of `before`: for good, or so that `undo` can take it back.
/// @param what names the change, as in "Undo …".
template <class List>
void change_list(QUndoStack* undo, const QString& what, const List& before, List after,
                 typename ListChange<List>::Put put) {
  if (undo) {
    undo->push(new ListChange<List>(what, before, std::move(after), std::move(put)));
  } else {
    put(after);
  }
}

}  // namespace transillum::viewer

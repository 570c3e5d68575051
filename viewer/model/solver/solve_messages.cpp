// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/solve_messages.h"

#include <QMetaObject>
#include <new>
#include <utility>

#include "support/failure_text.h"
#include "transillum/errors.h"

namespace transillum::viewer {

void SolveMessages::post_state(RunState state) {
  post([this, state] {
    if (state == state_) {
      return;
    }
    state_ = state;
    emit state_changed(state);
  });
}

void SolveMessages::post_scene(std::shared_ptr<const LoadedScene> loaded) {
  {
    const std::lock_guard lock(mutex_);
    pending_snapshot_ = nullptr;
  }
  post([this, loaded = std::move(loaded)] {
    const bool is_open = announced_ && is_same_origin(announced_, loaded);
    announced_ = loaded;
    if (is_open) {
      emit patches_changed(loaded);
    } else {
      emit scene_loaded(loaded);
    }
    deliver_snapshot();
  });
}

void SolveMessages::post_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  const std::lock_guard lock(mutex_);
  const bool message_queued = pending_snapshot_ != nullptr;
  if (!message_queued) {
    post([this] { deliver_snapshot(); });
  }
  // After post(), which may throw: a pending snapshot without its message would block all others.
  pending_snapshot_ = std::move(snapshot);
}

void SolveMessages::deliver_snapshot() {
  std::shared_ptr<const SolverSnapshot> newest;
  {
    const std::lock_guard lock(mutex_);
    // A snapshot of a scene that is not announced yet waits for the announcement.
    if (!pending_snapshot_ || pending_snapshot_->loaded != announced_) {
      return;
    }
    newest = std::exchange(pending_snapshot_, nullptr);
  }
  emit snapshot_ready(newest);
}

void SolveMessages::post_load_progress(const QString& phase, double fraction) {
  post([this, phase, fraction] { emit load_progressed(phase, fraction); });
}

void SolveMessages::post_current_failure(const QString& no_memory) {
  QString message;
  bool bad_input = false;
  try {
    throw;
  } catch (const Canceled&) {
    return;  // by the user, or by a newer request, which is handled next
  } catch (const InputError& error) {
    message = QString::fromStdString(error.what());
    bad_input = true;
  } catch (const std::bad_alloc&) {
    message = no_memory.isEmpty() ? current_failure_text() : no_memory;
  } catch (...) {
    message = current_failure_text();
  }
  post([this, message, bad_input] { emit failed(message, bad_input); });
}

void SolveMessages::post(std::function<void()> message) {
  QMetaObject::invokeMethod(this, std::move(message), Qt::QueuedConnection);
}

}  // namespace transillum::viewer

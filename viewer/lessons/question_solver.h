// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <atomic>
#include <memory>

#include "lessons/computed_values.h"
#include "lessons/question.h"
#include "model/snapshot.h"
#include "support/newest_result.h"

namespace transillum::viewer {

/// A question about the scene of its page.
struct QuestionRequest {
  std::shared_ptr<const LoadedScene> loaded;
  Question question;
  /// The finished fraction, 0 to 1; null: progress is not reported.
  std::shared_ptr<std::atomic<double>> done = nullptr;
};

/// Computes what is right, on a thread of its own.
class QuestionSolver : public NewestResult<QuestionRequest, Solved> {
 public:
  /// @param owner, deliver  as for NewestResult
  QuestionSolver(QObject& owner, Deliver deliver)
      : NewestResult(
            owner,
            [](const QuestionRequest& request, const Cancellation& cancellation) {
              ComputedValues computed(request.loaded, cancellation,
                                      [done = request.done](double fraction) {
                                        if (done) {
                                          *done = fraction;
                                        }
                                      });
              return solve_question(request.question, computed);
            },
            std::move(deliver)) {}
};

}  // namespace transillum::viewer

// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/solver_group.h"

#include <exception>

namespace transillum {

bool SolverGroup::any(bool value) {
  double largest = value ? 1 : 0;
  maxima({&largest, 1});
  return largest > 0;
}

double SolverGroup::from_first(double value) {
  double first = rank() == 0 ? value : -1;
  maxima({&first, 1});
  return first;
}

void SolverGroup::agree(const std::function<void()>& body) {
  std::exception_ptr error;
  try {
    body();
  } catch (...) {
    error = std::current_exception();
  }
  const bool failed = any(error != nullptr);
  if (error) {
    std::rethrow_exception(error);
  }
  if (failed) {
    throw MemberFailed();
  }
}

}  // namespace transillum

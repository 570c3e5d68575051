// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The state of a solver as bytes: all that its passes and iterations have changed. What it starts
// from, and what follows from that, is made again.
#include <istream>
#include <ostream>

#include "radiosity/solver/solver_state.h"
#include "radiosity/state_archive.h"

namespace transillum {

template <class Archive, class Self>
void RadiositySolver::Impl::visit_state(Archive& archive, Self& self) {
  archive(self.kept, self.statistics, self.whole, self.replicas, self.iteration, self.history,
          self.timing);
}

void RadiositySolver::Impl::save(std::ostream& out) const {
  StateOutput archive(out);
  archive(plan.added_replicas());
  visit_state(archive, *this);
}

void RadiositySolver::Impl::restore(std::istream& in, std::uint64_t size) {
  StateInput archive(in, size);
  constexpr int most_added = 64;  // an accuracy plan stops at 16 replicas
  int added = 0;
  archive(added);
  archive.require(added >= 0 && added <= most_added && (added == 0 || plan.replicas() > 1));
  for (int r = 0; r < added; ++r) {
    append_replica();
  }
  if (added > 0) {
    iteration.directions = plan.directions(0);
  }
  visit_state(archive, *this);
  archive.finish();
  archive.require(whole.passes() <= plan.directions() &&
                  statistics.areas().passes <= plan.directions() &&
                  iteration.from_kept_sums <= plan.directions());
  if (plan.renews() && history.size() > 0) {
    iteration.directions = plan.directions(iteration.begun ? history.size() : history.size() - 1);
  }
}

void RadiositySolver::save(std::ostream& out) const {
  impl_->complete();
  impl_->kept.prepare_to_save();
  impl_->save(out);
}
void RadiositySolver::restore(std::istream& in, std::uint64_t size) { impl_->restore(in, size); }

}  // namespace transillum

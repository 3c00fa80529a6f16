#include "solver/stepping/journal.hpp"

#include <stdexcept>
#include <type_traits>

namespace snug::solver {

// One list of members for writing and reading, so that the two agree.
template <class Archive, class I>
  requires std::is_same_v<std::remove_const_t<I>, postproc::Iteration>
static void each(Archive& with, I& i) {
  with(i.increment), with(i.load), with(i.iteration), with(i.residual), with(i.complementarity), with(i.step);
  with(i.contact_nodes), with(i.changed), with(i.energy), with(i.seconds), with(i.event), with(i.attempt);
}

template <class Archive, class R>
  requires std::is_same_v<std::remove_const_t<R>, PathRecord>
static void each(Archive& with, R& r) {
  each(with, r.state), with(r.before);
  with(r.reached), with(r.span), with(r.step), with(r.increments), with(r.lost), with(r.crept), with(r.slid), with(r.ended), with(r.complete);
  with(r.message), with(r.rows);
}

std::optional<PathRecord> Journal::begin() {
  if (!stopped_ && begun_++ < paths_.size()) return paths_[begun_ - 1];
  return {};
}

void Journal::note(const PathRecord& record) {
  if (stopped_) return;
  paths_.resize(begun_);
  paths_.back() = record;
  if (change_) change_(*this);
}

void Journal::stop() {
  if (!stopped_ && !paths_.empty() && change_) change_(*this);
  stopped_ = true;
}

std::string Journal::bytes() const {
  ByteWriter writer;
  writer(paths_);
  return std::move(writer.bytes);
}

Journal Journal::of_bytes(std::string_view bytes) {
  Journal journal;
  ByteReader reader(bytes);
  reader(journal.paths_);
  reader.finish();
  return journal;
}

}  // namespace snug::solver

#include "solver/stepping/journal.hpp"

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace snug::solver {

namespace {

class Writer {
 public:
  template <class T>
    requires std::is_arithmetic_v<T>
  void operator()(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    bytes += text;
  }
  void operator()(const Eigen::VectorXd& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    bytes.append(reinterpret_cast<const char*>(values.data()), sizeof(double) * static_cast<std::size_t>(values.size()));
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(static_cast<std::uint64_t>(list.size()));
    for (const T& item : list) {
      if constexpr (requires { (*this)(item); })
        (*this)(item);
      else
        each(*this, item);
    }
  }
  std::string bytes;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
    requires std::is_arithmetic_v<T>
  void operator()(T& value) {
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  void operator()(std::string& text) { text = take(count(1)); }
  void operator()(Eigen::VectorXd& values) {
    const std::size_t size = count(sizeof(double));
    values.resize(static_cast<Eigen::Index>(size));
    if (size > 0) std::memcpy(values.data(), take(sizeof(double) * size).data(), sizeof(double) * size);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    list.resize(count(1));
    for (T& item : list) {
      if constexpr (requires { (*this)(item); })
        (*this)(item);
      else
        each(*this, item);
    }
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw std::runtime_error("the bytes end too soon");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  /// A number of items of at least so many bytes each, which must be there.
  std::size_t count(std::size_t each) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > rest_.size() / each) throw std::runtime_error("the bytes end too soon");
    return static_cast<std::size_t>(count);
  }
  std::string_view rest_;
};

// One list of members for writing and reading, so that the two agree.
template <class Archive, class S>
  requires std::is_same_v<std::remove_const_t<S>, State>
void each(Archive& with, S& s) {
  with(s.values), with(s.load), with(s.reference), with(s.traction), with(s.release), with(s.stiffening);
}

template <class Archive, class I>
  requires std::is_same_v<std::remove_const_t<I>, postproc::Iteration>
void each(Archive& with, I& i) {
  with(i.increment), with(i.load), with(i.iteration), with(i.residual), with(i.complementarity), with(i.step);
  with(i.contact_nodes), with(i.changed), with(i.energy), with(i.seconds), with(i.event), with(i.attempt);
}

template <class Archive, class R>
  requires std::is_same_v<std::remove_const_t<R>, PathRecord>
void each(Archive& with, R& r) {
  each(with, r.state), each(with, r.before);
  with(r.reached), with(r.span), with(r.step), with(r.increments), with(r.lost), with(r.ended), with(r.complete);
  with(r.message), with(r.rows), with(r.memory.active), with(r.memory.coupled), with(r.memory.cut);
}

}  // namespace

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
  Writer writer;
  writer(paths_);
  return std::move(writer.bytes);
}

Journal Journal::of_bytes(std::string_view bytes) {
  Journal journal;
  Reader reader(bytes);
  reader(journal.paths_);
  if (!reader.at_end()) throw std::runtime_error("the bytes go on after their end");
  return journal;
}

}  // namespace snug::solver

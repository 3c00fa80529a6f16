// The state of a scene: a value. Copy it to keep it, assign it to go back. Everything that an answer depends on is in it.
#pragma once

#include <Eigen/Core>

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "solver/algebra/bytes.hpp"

namespace snug::solver {

/// What a term remembers from one state to the next.
class History {
 public:
  virtual ~History() = default;
  /// What `Term::restore` reads.
  virtual void write(ByteWriter& writer) const = 0;
};

/// A history as it was read from a file, before its term has looked at it.
class StoredHistory : public History {
 public:
  explicit StoredHistory(std::string bytes) : bytes(std::move(bytes)) {}
  void write(ByteWriter& writer) const override { writer.bytes += bytes; }
  std::string bytes;
};

/// The histories of a state's terms by their names. States share them until one of them is changed.
class Histories {
 public:
  bool has(const std::string& name) const { return list_.contains(name); }
  /// Throws std::logic_error where the state has none of that name and type.
  template <class T>
  const T& get(const std::string& name) const {
    const T* found = find<T>(name);
    if (!found) throw std::logic_error("the state has no history of " + name);
    return *found;
  }
  template <class T>
  const T* find(const std::string& name) const {
    const auto it = list_.find(name);
    return it == list_.end() ? nullptr : dynamic_cast<const T*>(it->second.get());
  }
  /// One that no other state sees: a copy where it is shared, a new one where there is none.
  template <class T>
  T& edit(const std::string& name) {
    std::shared_ptr<History>& history = list_[name];
    const T* known = dynamic_cast<const T*>(history.get());
    if (!known)
      history = std::make_shared<T>();
    else if (history.use_count() > 1)
      history = std::make_shared<T>(*known);
    return static_cast<T&>(*history);
  }
  const std::map<std::string, std::shared_ptr<History>>& list() const { return list_; }
  void put(const std::string& name, std::shared_ptr<History> history) { list_[name] = std::move(history); }

 private:
  std::map<std::string, std::shared_ptr<History>> list_;
};

struct State {
  Eigen::VectorXd values;   ///< see Layout
  double load = 0.0;        ///< s: 0 = placed and strain-free, 1 = the garment's rest metric is its pattern's
  /// What of friction's bound there is: the bound is mu p / release, so that 1 is Coulomb's law and 0 sticks without a bound.
  double release = 1.0;
  double stiffening = 1.0;  ///< factor on the body's own energy while it is released under the garment; 1 at the end
  /// How contact yields: 0 is hard; else a pressure is what the contact's own stiffness over this makes of the gap, as on a mattress.
  double yielding = 0.0;
  double posture = 0.0;     ///< progress of the movement after dressing (scene/movement.hpp)
  Histories history;
};

/// To the last bit. Histories come back as they were stored: a scene restores them.
void each(ByteWriter& writer, const State& state);
void each(ByteReader& reader, State& state);

}  // namespace snug::solver

// Wrong input, and what was said of it before: often the cause, such as a unit that was guessed or a length that no body has.
#pragma once

#include <utility>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::input {

class WarnedError : public InputError {
 public:
  WarnedError(const InputError& error, std::vector<Diagnostic> before) : InputError(error), warnings_(std::move(before)) {
    if (const auto* warned = dynamic_cast<const WarnedError*>(&error)) warnings_.insert(warnings_.end(), warned->warnings_.begin(), warned->warnings_.end());
  }
  /// In the order in which they were said.
  const std::vector<Diagnostic>& warnings() const { return warnings_; }

 private:
  std::vector<Diagnostic> warnings_;
};

/// Does `work`; an InputError that it ends in takes `before`, as it is then, along as warnings.
template <class Work>
auto with_warnings(const std::vector<Diagnostic>& before, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw WarnedError(error, before);
  }
}

}  // namespace snug::input

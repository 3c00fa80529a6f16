// The files that a case names.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "cases/input/case.hpp"

namespace snug::input {

/// Visitor over `describe`: collects the members that are files.
class NamedFiles {
 public:
  template <class Member>
  void operator()(const Field&, const Member& member) {
    add(member);
  }
  std::vector<std::filesystem::path> files() && { return std::move(files_); }

 private:
  void add(const std::filesystem::path& file) {
    if (!file.empty()) files_.push_back(file);
  }
  template <class T>
  void add(const std::optional<T>& member) {
    if (member) add(*member);
  }
  template <class T>
  void add(const std::vector<T>& members) {
    for (const T& member : members) add(member);
  }
  template <class T>
  void add(const T& member) {
    if constexpr (requires { T::describe(member, *this); }) T::describe(member, *this);
  }

  std::vector<std::filesystem::path> files_;
};

/// In the order of the keys, as resolved when the case was read; what is named without a key of its own for files (materials, curves of sensation) is
/// not among them.
inline std::vector<std::filesystem::path> named_files(const Case& description) {
  NamedFiles found;
  Case::describe(description, found);
  return std::move(found).files();
}

}  // namespace snug::input

// Values to bytes and back, to the last bit, for the same machine.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace snug::solver {

/// Structs are written member by member by a function `each(archive, value)` that writing and reading share.
class ByteWriter {
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

/// Throws std::runtime_error where the bytes end too soon.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
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
  /// Throws std::runtime_error where something is left.
  void finish() const {
    if (!at_end()) throw std::runtime_error("the bytes go on after their end");
  }

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

}  // namespace snug::solver

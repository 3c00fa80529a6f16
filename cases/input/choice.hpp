// A choice: an enum whose texts stand in one function beside it, found by argument-dependent look-up,
//
//   enum class Tier { L0, L1, L4 };
//   constexpr auto texts_of(Tier) { return std::array{"L0", "L1", "L4"}; }
//
// in the order of the enumerators. Visitors over a `describe` read and write it as one of these texts.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace snug::input {

template <class T>
concept Choice = std::is_enum_v<T> && requires(T value) { texts_of(value); };

template <Choice T>
std::string text_of(T value) {
  return texts_of(value).at(static_cast<std::size_t>(value));
}

template <Choice T>
std::vector<std::string> choices_of() {
  const auto texts = texts_of(T{});
  return {texts.begin(), texts.end()};
}

/// The enumerator of a text, if it is one.
template <Choice T>
std::optional<T> choice_of(const std::string& text) {
  const auto texts = texts_of(T{});
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (text == texts[i]) return static_cast<T>(i);
  return std::nullopt;
}

}  // namespace snug::input

// Tells whether bytes are the same, not who wrote them.
#pragma once

#include <cstdint>
#include <string_view>

namespace snug::app {

/// FNV-1a, 64 bits; goes on from `hash`.
inline std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = 14695981039346656037ULL) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return hash;
}

}  // namespace snug::app

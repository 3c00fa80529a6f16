#include "mesh/pattern/svg_text.hpp"

#include <fmt/format.h>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;

/// Bytes of the UTF-8 character that begins a text; 0: none does.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return n < text.size() ? static_cast<unsigned char>(text[n]) : 0u; };
  const std::size_t length = byte(0) < 0x80                      ? 1
                             : byte(0) >= 0xC2 && byte(0) < 0xE0 ? 2
                             : byte(0) >= 0xE0 && byte(0) < 0xF0 ? 3
                             : byte(0) >= 0xF0 && byte(0) < 0xF5 ? 4
                                                                 : 0;
  for (std::size_t n = 1; n < length; ++n)
    if ((byte(n) & 0xC0u) != 0x80u) return 0;
  if ((byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) >= 0xA0) ||
      (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) >= 0x90))
    return 0;
  return length;
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character(text);
    const char c = text.front();
    if (length > 1)
      result += text.substr(0, length);
    else if (length == 0 || static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += '?';
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string path_on(const Curve& curve, const Vector2d& shift) {
  const auto point = [&](const Vector2d& p) {
    return fmt::format(" {:.6f} {:.6f}", 1e3 * p.x() + shift.x(), shift.y() - 1e3 * p.y());
  };
  std::string path;
  for (const Span& span : without_arcs(curve)) {
    if (const auto* q = std::get_if<Quadratic>(&span))
      path += " Q" + point(q->control) + point(q->to);
    else if (const auto* c = std::get_if<Cubic>(&span))
      path += " C" + point(c->first) + point(c->second) + point(c->to);
    else
      path += " L" + point(at(span, 1.0));
  }
  return path;
}

}  // namespace snug::mesh

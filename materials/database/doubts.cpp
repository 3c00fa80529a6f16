#include "materials/database/doubts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "materials/fabric/sheet.hpp"

namespace snug::materials {

namespace {

constexpr double apart = 0.05;

std::optional<double> number(const Entity& entity, const std::string& item) {
  const Datum* datum = entity.find(item);
  return datum ? datum->si : std::nullopt;
}

bool differ(double a, double b) { return std::abs(a - b) > apart * std::max(std::abs(a), std::abs(b)); }

void compare_density(const Entity& entity, std::vector<std::string>& doubts) {
  const auto weight = number(entity, "weight"), thickness = number(entity, "thickness"),
             density = number(entity, "density");
  if (!weight || !thickness || !density || *thickness <= 0.0 || !differ(*weight / *thickness, *density)) return;
  doubts.push_back(
      fmt::format("weight over thickness is {:.4g} kg/m3, the density {:.4g} kg/m3", *weight / *thickness, *density));
}

void compare_work(const Entity& entity, const std::string& direction, std::vector<std::string>& doubts) {
  const auto LT = number(entity, direction + "LT"), WT = number(entity, direction + "WT"),
             Fm = number(entity, direction + "Fm"), EMT = number(entity, direction + "EMT");
  if (!LT || !WT || !Fm || !EMT || !differ(*WT, 0.5 * *LT * *Fm * *EMT)) return;
  doubts.push_back(fmt::format("{}WT is {:.4g} J/m2, LT Fm EMT/2 {:.4g} J/m2", direction, *WT, 0.5 * *LT * *Fm * *EMT));
}

void compare_compression(const Entity& entity, std::vector<std::string>& doubts) {
  const Compression compression{.LC = number(entity, "LC"), .WC = number(entity, "WC"), .T0 = number(entity, "T0"), .Tm = number(entity, "Tm"), .Pm = number(entity, "Pm")};
  const auto decrease = compression.decrease(), thickness = compression.T0 ? compression.T0 : number(entity, "thickness");
  if (!decrease || !thickness || *decrease < *thickness) return;
  doubts.push_back(fmt::format("LC and WC press it by {:.3g} mm, the thickness is {:.3g} mm", 1e3 * *decrease, 1e3 * *thickness));
}

void compare_range(const Datum& datum, std::vector<std::string>& doubts) {
  const auto value = plain_number(datum.value), low = plain_number(datum.low), high = plain_number(datum.high);
  if (datum.type == DatumType::value && value && low && high && (*value < *low || *value > *high))
    doubts.push_back(
        fmt::format("{} = {} is outside its range, {} to {}", datum.name, datum.value, datum.low, datum.high));
}

}  // namespace

std::vector<std::string> doubts_of(const Entity& entity) {
  std::vector<std::string> doubts;
  compare_density(entity, doubts);
  for (const char* direction : {"", "weft."}) compare_work(entity, direction, doubts);
  compare_compression(entity, doubts);
  for (const Datum& datum : entity.data) compare_range(datum, doubts);
  return doubts;
}

}  // namespace snug::materials

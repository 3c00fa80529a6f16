#include "materials/database/snapshot.hpp"

#include <nlohmann/json.hpp>

namespace snug::materials {

std::string snapshot(const Entity& entity) {
  nlohmann::json data = nlohmann::json::array();
  for (const Datum& one : entity.data)
    data.push_back({one.name, one.shipped, input::text_of(one.type), one.symbol, one.value, one.unit, one.uncertainty,
                    one.low, one.high, one.source});
  return nlohmann::json{{"kind", input::text_of(entity.kind)},
                        {"id", entity.id},
                        {"parent", entity.parent},
                        {"shipped", entity.shipped},
                        {"data", data}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Entity from_snapshot(const std::string& text) try {
  const nlohmann::json json = nlohmann::json::parse(text);
  Entity entity{.kind = input::choice_of<Kind>(json.at("kind")).value(),
                .id = json.at("id"),
                .parent = json.at("parent"),
                .shipped = json.at("shipped")};
  for (const nlohmann::json& one : json.at("data"))
    entity.data.push_back({.name = one.at(0),
                           .symbol = one.at(3),
                           .type = input::choice_of<DatumType>(one.at(2)).value(),
                           .value = one.at(4),
                           .unit = one.at(5),
                           .uncertainty = one.at(6),
                           .low = one.at(7),
                           .high = one.at(8),
                           .source = one.at(9),
                           .shipped = one.at(1)});
  return entity;
} catch (const std::exception&) {
  throw input::InputError({"library", 0, 0}, "the history of the library is damaged",
                          "nothing was changed; put a backup in its place");
}

}  // namespace snug::materials

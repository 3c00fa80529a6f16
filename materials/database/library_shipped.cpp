// What ships, in the library's file.
#include <algorithm>

#include "materials/database/library.hpp"
#include "materials/database/store.hpp"

namespace snug::materials {

void Library::bring_shipped_up_to_date() {
  const auto edition = [&] {
    sql::Statement note = store_->connection.prepare("SELECT value FROM note WHERE name = 'shipped'");
    return note.step() ? note.text(0) : std::string();
  };
  if (edition() == store_->settings.edition) return;
  const Entries shipped = store_->settings.shipped(store_->units);
  change([&](Stroke& stroke) {
    if (edition() == store_->settings.edition) return;  // another process was faster
    store_->shipping = true;
    for (const std::string& id : ids()) {  // what does not ship any more is the user's
      auto entity = find(id);
      if (!entity->shipped || std::any_of(shipped.entities.begin(), shipped.entities.end(),
                                          [&](const Entity& one) { return one.id == id; }))
        continue;
      entity->shipped = false;
      for (Datum& datum : entity->data) datum.shipped = false;
      stroke.put(*std::move(entity), "ships no longer");
    }
    for (const LibraryFile& file : shipped.files) stroke.keep(file);
    for (Entity entity : shipped.entities) {
      entity.shipped = true;
      for (Datum& datum : entity.data) datum.shipped = true;
      const auto before = find(entity.id);
      if (before && !before->shipped) {
        std::string other = entity.id + " own";
        while (find(other)) other += " own";
        store_->rename(*before, other);
      } else if (before) {  // own items stay, behind
        for (const Datum& datum : before->data)
          if (!datum.shipped) entity.data.push_back(datum);
      }
      stroke.put(std::move(entity), "shipped");
    }
    store_->connection
        .prepare("INSERT INTO note (name, value) VALUES ('shipped', ?1) ON CONFLICT (name) DO UPDATE SET value = ?1")
        .bind(1, store_->settings.edition)
        .run();
  });
  store_->shipping = false;
}

std::vector<std::string> Library::differences(const Entries& shipped) const {
  std::vector<std::string> lines;
  for (Entity entity : shipped.entities) {
    gather(entity);
    for (Datum& datum : entity.data) datum.shipped = true;
    auto found = find(entity.id);
    if (found) std::erase_if(found->data, [](const Datum& datum) { return !datum.shipped; });
    if (!found || !found->shipped)
      lines.push_back(entity.id + ": in the text, not in the library");
    else if (!found->same_content(entity))
      lines.push_back(entity.id + ": the library has other values than the text");
  }
  sql::Statement held = store_->connection.prepare("SELECT id FROM entity WHERE shipped = 1 ORDER BY number");
  while (held.step()) {
    const std::string id = held.text(0);
    if (std::none_of(shipped.entities.begin(), shipped.entities.end(), [&](const Entity& one) { return one.id == id; }))
      lines.push_back(id + ": in the library, not in the text");
  }
  return lines;
}

}  // namespace snug::materials

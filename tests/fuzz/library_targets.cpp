// What users hand in to the engineering database.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "cases/input/table.hpp"
#include "materials/database/curve.hpp"
#include "materials/database/equation.hpp"
#include "materials/database/exchange.hpp"
#include "materials/database/named.hpp"
#include "materials/database/query.hpp"
#include "materials/database/runs.hpp"
#include "materials/database/schema.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/texts.hpp"

namespace snug::fuzz {

namespace {

namespace fs = std::filesystem;

/// The bytes of a small library, in pages of 512 bytes so that it is short.
std::string library_file() {
  const fs::path file = fs::temp_directory_path() / fmt::format("snug-fuzz-library-{}.db", ::getpid());
  fs::remove(file);
  {
    materials::sql::Connection connection(file, materials::sql::Connection::Open::or_new);
    connection.execute("PRAGMA page_size = 512");
    materials::sql::bring_up_to_date(connection);
  }
  {
    materials::Library library({.file = file});
    library.change([](materials::Stroke& stroke) {
      stroke.put({.kind = materials::Kind::garment, .id = "g"}, "added");
      stroke.put({.kind = materials::Kind::fabric,
                  .id = "f",
                  .parent = "g",
                  .data = {{.name = "weight", .value = "100", .unit = "g/m2"}, {.name = "hand", .value = "soft"}}},
                 "added");
    });
    const materials::LibraryFile echo{.hash = "e", .name = "run:case.echo.toml", .content = "title = \"t\""};
    materials::RunRecord run{.project = "p", .title = "t", .directory = "/p", .place = "/p/out", .proof = "0", .case_hash = "c",
                             .echo = echo.hash, .command = "snug run p", .status = "converged", .message = {}, .note = {}};
    run.results = {{.name = "Front thigh", .value = "1", .unit = "Pa", .number = 1.0}};
    materials::Runs(library).record(run, {echo});
  }
  const std::string bytes = text_of(file);
  fs::remove(file);
  return bytes;
}

/// A file of the library that somebody has damaged: asked, written to, undone.
void use_library(const fs::path& file, const std::string& bytes) {
  for (const char* beside : {"", "-wal", "-shm"}) fs::remove(file.string() + beside);
  put(file, bytes);
  materials::Library library({.file = file});
  for (const std::string& id : library.ids()) library.find(id), library.children(id);
  library.find_where("weight < 1 kg/m2 and hand ~ o or has weight");
  library.history();
  library.change([](materials::Stroke& stroke) {
    stroke.put({.kind = materials::Kind::fabric, .id = "n", .data = {{.name = "weight", .value = "1", .unit = "g/m2"}}},
               "added");
  });
  library.undo(true);
  library.undo(true);
  materials::Runs runs(library);
  runs.projects();
  for (const materials::RunRecord& head : runs.heads()) runs.run(head.number), runs.note(head.number, "n"), runs.forget({head.number});
  library.check_file();
}

/// A text of entities; what is read whole is written and read to the same, and is a law's table or refused.
void use_entities(const fs::path& file, const std::string& text) {
  put(file, text);
  materials::UnitBook units;
  const materials::Entries entries = materials::read_entries(file, materials::Kind::fabric, units);
  const auto by_hash = [](const std::string& hash) { return hash; };
  for (const materials::Entity& entity : entries.entities) {
    materials::law_table(entity, units);
    input::Diagnostics diagnostics;
    std::vector<materials::LibraryFile> files;
    input::Table table;
    table.set("e", input::value_without_place(materials::to_table(entity, by_hash)));
    const input::Table again = input::table_of(input::to_toml(table), {"again", 1, 1});
    if (std::any_of(entity.data.begin(), entity.data.end(), [](const materials::Datum& one) {
          return one.type == materials::DatumType::table || one.type == materials::DatumType::figure;
        }))
      continue;
    const auto none = [](const std::string&, const input::Location&) { return std::string(); };
    if (!materials::same_values(
            entity, materials::entity_of(entity.kind, entity.id, *again.table("e"), none, units, files, diagnostics)))
      throw std::logic_error("an entity reads back as another: " + entity.id);
  }
}

}  // namespace

std::vector<Target> library_targets() {
  const fs::path data = fs::path(SNUG_SOURCE_DIR) / "materials/data/library";
  const auto before = [&](const char* file, const char* end) {
    return text_of(data / file).substr(0, text_of(data / file).find(end));
  };
  const auto entities = [](const char* ending) {
    return [ending](const fs::path& file, const std::string& text) { use_entities(with_ending(file, ending), text); };
  };
  const auto question = [](const fs::path&, const std::string& text) {
    materials::UnitBook units;
    materials::parse_question(text, units,
                              [](const std::string& name) {
                                return name == "composition" ? std::optional<std::string>("text")
                                       : name == "weight"    ? std::optional<std::string>("kg/m2")
                                       : name == "LT"        ? std::optional<std::string>("")
                                                             : std::nullopt;
                              },
                              {"weight", "LT", "composition"});
  };
  const auto equation = [](const fs::path&, const std::string& text) {
    const materials::Equation parsed = materials::Equation::parse(text, {"fuzz", 1, 1});
    parsed.value([](const std::string&) { return 1.5; });
    parsed.dimension(
        [](const std::string& symbol) { return symbol == "h" ? materials::Dimension("m") : materials::Dimension(); });
  };
  const auto curve = [](const fs::path&, const std::string& text) {
    materials::UnitBook units;
    const materials::Curve parsed = materials::Curve::parse(text, "fuzz", units);
    for (const double share : {0.0, 0.3, 1.0})
      parsed.at(parsed.x.values.front() + share * (parsed.x.values.back() - parsed.x.values.front()));
  };
  return {
      {"library",
       use_library,
       {library_file()},
       {std::string(16, '\0'), "\xff\xff", "\x01", "snug", "value", "fabric"}},
      {"entities",
       entities(".toml"),
       {before("examples.toml", "[fabric.\"woven fabric of table 2.9\"]"), before("denims.toml", "[garment.002]"),
        before("wear_trial.toml", "[fabric.N85L15]")},
       {"[fabric.x]\n", "= { value = \"", "equation = \"", "unit = \"", " +- ", "[[", "weft.LT", "terms.1.mu",
        "range = [", "\"1e999\"", "nan", "parent = \"", "%", "\n", "table = \"../x\""}},
      {"entities.json",
       entities(".json"),
       {R"({"fabric": {"a": {"weight": "1.0 +- 0.1 g/m2", "LT": [{"value": "1", "range": ["0", "2"]}, {"equation": "c*2"}], "c": 2}}})"},
       {"{", "}", "[", "]", "\"value\": ", "\"equation\": ", "1e999", "null", "true", "\"\\u0000\"", ",", ":"}},
      {"entities.csv",
       entities(".csv"),
       {"kind,id,parent,item,type,value,unit,uncertainty,low,high,symbol,source\nfabric,a,,weight,value,1.0,g/"
        "m2,0.1,0,2,w,table\nfabric,a,,x,equation,w*2,g/m2,,,,,\n",
        "id,weight [g/m2],LT\na,180,0.9\nb,1 +- 2,1\n"},
       {",", "\"", "\n", "equation", "[mm]", "1e999", "nan", "+-", "fabric,"}},
      {"question",
       question,
       {"weight < 250 g/m2 and LT > 1 or not (composition ~ \"a b\" and has LT)", "id = x and parent != \"y\""},
       {"and ", "or ", "not ", "(", ")", "\"", "<", "=", "~", "weight", "1e999", "g/m2"}},
      {"equation",
       equation,
       {"2*(a/b)*(c*d*h/h)^-0.5 + min(a, sqrt(b))", "exp(-a/b)*sin(pi*c)"},
       {"(", ")", "^", "*", "-", "h", "1e308", "sqrt(", ",", "max("}},
      {"curve",
       curve,
       {text_of(data / "weft_tensile.csv"), "x,y\n0,1\n2,5\n"},
       {",", "\n", "[%]", "1e308", "-1e308", "nan", "#", "\""}},
  };
}

}  // namespace snug::fuzz

// Seeded mutation fuzzer of the readers of text that users hand in. No reader may crash, throw anything but InputError,
// or take longer than five seconds (of a machine that others use too) for a text of at most 64 kB.
//
// usage: snug_fuzz SECONDS [SEED [READER]]     exit status 1: a text was found, and kept in snug-fuzz-READER.txt
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "cases/input/csv.hpp"
#include "cases/input/table.hpp"
#include "mesh/body/foreign.hpp"
#include "mesh/formats/triangle_surface.hpp"
#include "postproc/listing_reader.hpp"
#include "postproc/nodal_field.hpp"
#include "postproc/comfort/curve_fit.hpp"
#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/fuzzy_file.hpp"
#include "postproc/comfort/membership_fit.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t longest = 65536;

/// A reader of a file, texts to begin with, and pieces that matter to its format.
struct Target {
  std::string name;
  std::function<void(const fs::path&, const std::string&)> read;
  std::vector<std::string> seeds, pieces;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<Target> targets() {
  const fs::path source = SNUG_SOURCE_DIR, listings = source / "tests/data/listings", models = source / "tests/data/models";
  const auto listing = [](const fs::path&, const std::string& text) {
    input::Diagnostics diagnostics;
    const auto tables = postproc::parse_listing(text, "fuzz", diagnostics);
    for (const postproc::ListingTable& table : tables)
      if (table.values.size() != table.rows.size() * table.labels.size())
        throw std::logic_error("rows and values differ");
    postproc::field_of(tables, {});
  };
  const auto toml = [](const fs::path&, const std::string& text) {
    input::Diagnostics diagnostics;
    input::parse_text(text, {"fuzz", 1, 1}, diagnostics);
  };
  const auto put = [](const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; };
  const auto curves = [put](const fs::path& file, const std::string& text) {
    put(file, text);
    input::Diagnostics diagnostics;
    const input::Csv csv = input::read_csv(file, diagnostics);
    diagnostics.throw_if_any();
    postproc::fit_curves(csv);
    for (const char* shape : {"piecewise", "logistic"}) postproc::fit_curves(csv, shape);
    postproc::fit_memberships(csv);
  };
  const auto curve_file = [put](const fs::path& file, const std::string& text) {
    const fs::path toml_file = file.string() + ".toml";
    put(toml_file, text);
    input::MaterialReference reference;
    reference.name = toml_file.filename().string();
    const postproc::SensationCurves set = postproc::find_curves(reference, toml_file.parent_path());
    for (const postproc::SensationCurve& curve : set.curves) postproc::rate(curve, 1e3);
  };
  const auto fuzzy = [](postproc::FuzzyFormat format) {
    return [format](const fs::path&, const std::string& text) {
      postproc::FuzzySystem system = postproc::read_fuzzy_text(text, format, "fuzz");
      system.resolution = std::min(system.resolution, 101);
      postproc::infer(system, std::vector<double>(system.inputs.size(), 1.0));
    };
  };
  // A model that is read whole must also become a body, or be refused.
  const auto model_by = [](auto parse) {
    return [parse](const fs::path&, const std::string& text) {
      input::Diagnostics diagnostics;
      const mesh::Model model = parse(text, "fuzz", diagnostics);
      diagnostics.throw_if_any();
      input::BodySpec spec;
      spec.kind = "imported", spec.mesh = "fuzz";
      mesh::body_of(model, spec);
    };
  };
  return {
      {"apdl",
       model_by(mesh::parse_apdl),
       {text_of(models / "double_pyramid.txt"), text_of(models / "block.cdb")},
       {"NBLOCK,6,SOLID\n", "EBLOCK,19,SOLID\n", "CMBLOCK,A,NODE,3\n(8i10)\n", "RLBLOCK,1,1,6,7\n", "(3i9,6e21.13e3)\n", "esize,,3\n",
        "d,all,all\n", "nsel,s,loc,x,0,1\n", "$", "!", ",", "\n", "-1\n", "99999999", "e,1,2,3,4\n", "a,1,2,3\n", "1e999"}},
      {"inp",
       model_by(mesh::parse_calculix),
       {text_of(models / "cube.inp")},
       {"*ELEMENT, TYPE=S6, ELSET=E\n", "*NSET, NSET=N, GENERATE\n", "*SHELL SECTION, ELSET=E, MATERIAL=M\n", "*", "**", ",", "\n", "=",
        "99999999", "1e999", "*DLOAD\n", "*ELASTIC\n", "*HYPERELASTIC, OGDEN, N=3\n"}},
      {"listing",
       listing,
       {text_of(listings / "shell_displacement.lis"), text_of(listings / "shell_stress.lis"),
        text_of(listings / "ansys_pages.lis")},
       {"NODE", "VALUE", " MINIMUM VALUES\n", "\n", "E-011", "E+060.", "-101", "************", ".....", "TOP/BOTTOM",
        "NaN", "  ELEMENT=       1\n", " PRINT S\n", "1\n", "99999999999", "\t"}},
      {"csv",
       curves,
       {text_of(source / "postproc/data/wear_trial_2002.csv")},
       {",", "\"", "[mm]", "\n", "#", "1e400", "nan"}},
      {"curves",
       curve_file,
       {text_of(source / "postproc/data/ral_gz_387.toml"),
        "name = \"a\"\nsource = \"b\"\npatch = \"c\"\npopulation = \"d\"\n[[curves]]\nlocation = \"calf\"\n"
        "shape = \"piecewise\"\nrange = [\"1 kPa\", \"2 kPa\"]\npressures = [\"1 kPa\", \"2 kPa\"]\nratings = [1, 2]\n"},
       {"[[curves]]\n", "[[bands]]\n", "logistic", "\"1 Pa\"", "1e999", "nan", "width = \"1e-300 Pa\"\n", "\n"}},
      {"fll",
       fuzzy(postproc::FuzzyFormat::fll),
       {text_of(source / "postproc/data/wear_trial_2002.fll")},
       {"term: ", "rule: if ", " and ", " or ", "(", ")", "Bell", "Function x*x", "Centroid", "nan", "1e999", "\n", ":"}},
      {"fis",
       fuzzy(postproc::FuzzyFormat::fis),
       {text_of(source / "postproc/data/wear_trial_2002.fis").substr(0, 4000) + "\n",
        "[System]\nName='a'\nType='mamdani'\nNumInputs=1\nNumOutputs=1\nNumRules=1\nAndMethod='min'\nOrMethod='max'\n"
        "ImpMethod='min'\nAggMethod='max'\nDefuzzMethod='centroid'\n[Input1]\nName='p'\nRange=[0 1]\nNumMFs=1\n"
        "MF1='a':'gbellmf',[0.5 2.5 0]\n[Output1]\nName='y'\nRange=[0 1]\nNumMFs=1\nMF1='b':'trimf',[0 1 2]\n"
        "[Rules]\n1, 1 (1) : 1\n"},
       {"MF1=", "[Rules]\n", "'trimf'", "-1", "(1) : 2", "99", "nan", "1e999", "\n", "="}},
      {"toml",
       toml,
       {text_of(source / "cases/thigh-sleeve/case.toml"), text_of(source / "cases/thigh-sleeve/expected.toml")},
       {"[[", "]]", "{", "}", "\"\"\"", "=", "'", "\\u", "1e999", "\n"}},
      {"surface",
       [put](const fs::path& file, const std::string& text) {
         put(file, text);
         mesh::read_surface(file);
       },
       {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
        "begin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nend\n",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid a\n"},
       {"f ", "v ", "1/2/3", "-1", "99999999999", "vertex ", "solid", "nan", "1e999", "\n"}},
  };
}

/// One to eight changes: bytes, pieces, cuts and repetitions.
std::string mutated(std::string text, const std::vector<std::string>& pieces, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t changes = 1 + below(8); changes > 0; --changes) {
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at, 200) + 1);
    switch (below(5)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(at, pieces[below(pieces.size())]);
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      default:
        if (at < text.size()) text[at] = "0123456789+-.E \n"[below(16)];
        break;
    }
  }
  return text.substr(0, longest);
}

// The text under test, for the handler of a crash or a hang.
std::string current_text, current_name;

void keep_text() { std::ofstream("snug-fuzz-" + current_name + ".txt", std::ios::binary) << current_text; }

void crashed(int signal) {
  keep_text();
  fmt::print(stderr, "{}: signal {} ({}), see snug-fuzz-{}.txt\n", current_name, signal,
             signal == SIGALRM ? "hang" : "crash", current_name);
  std::_Exit(1);
}

bool survives(const Target& target, const fs::path& file) {
  ::alarm(10);
  const auto start = Clock::now();
  try {
    target.read(file, current_text);
  } catch (const input::InputError&) {
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", target.name, error.what());
    return false;
  }
  ::alarm(0);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (seconds < 5.0) return true;
  fmt::print(stderr, "{}: {:.1f} s for {} bytes\n", target.name, seconds, current_text.size());
  return false;
}

int fuzz(double seconds, unsigned seed, const std::string& only) {
  const fs::path file = fs::temp_directory_path() / fmt::format("snug-fuzz-{}", ::getpid());
  std::vector<Target> all = targets();
  std::erase_if(all, [&](const Target& target) { return !only.empty() && target.name != only; });
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGALRM, SIGBUS}) std::signal(signal, crashed);
  for (const Target& target : all) {
    std::mt19937 random(seed);
    std::vector<std::string> corpus = target.seeds;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds / static_cast<double>(all.size()));
    long count = 0;
    current_name = target.name;
    for (; Clock::now() < end; ++count) {
      current_text = mutated(corpus[random() % corpus.size()], target.pieces, random);
      if (!survives(target, file)) {
        keep_text();
        return 1;
      }
      // Some mutants are mutated further, the seeds are kept.
      if (count % 50 == 0) {
        if (corpus.size() < 64)
          corpus.push_back(current_text);
        else
          corpus[target.seeds.size() + random() % (64 - target.seeds.size())] = current_text;
      }
    }
    fmt::print("{}: {} texts\n", target.name, count);
  }
  fs::remove(file);
  return 0;
}

}  // namespace
}  // namespace snug

int main(int argc, char** argv) {
  if (argc < 2 || std::atof(argv[1]) <= 0.0) {
    fmt::print(stderr, "usage: snug_fuzz SECONDS [SEED [READER]]     readers: apdl inp listing csv curves fll fis toml surface\n");
    return 2;
  }
  return snug::fuzz(std::atof(argv[1]), argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1,
                    argc > 3 ? argv[3] : "");
}

// Meshes that are scripts: what they may not do is refused by name and line, and gmsh works where it can do no harm.
#include "tests/attack/attack.hpp"

#include "cases/input/diagnostics.hpp"
#include "mesh/formats/contained.hpp"
#include "mesh/formats/geo_script.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

const std::string block = R"(SetFactory("OpenCASCADE");
// a block in two halves
h = 20; n() = {};
For k In {0:1}
  Box(k + 1) = {0, 0, 30*k, 40, 40, 30};
EndFor
v() = BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; };
If (h > 10 && h <= 30)
  Mesh.MeshSizeMax = h; Mesh.MeshSizeMin = h;
EndIf
Physical Volume("tissue") = {1, 2};
Macro Nothing
  a = 1;
Return
Call Nothing;
Mesh.Algorithm3D = 1;
)";

const std::string standing = block + "Physical Surface(\"floor\") = Surface In BoundingBox{-1, -1, -1, 41, 41, 1};\n";

/// What is said of a script, without its file; empty: admitted.
std::string verdict(const std::string& script) {
  try {
    mesh::checked_script(script, "m.geo");
  } catch (const input::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Scripts, GeometryIsAdmittedOnItsLines) {
  // A script of geometry, loops, macros, conditions and mesh options passes, word by word on the same lines.
  EXPECT_EQ(verdict(block), "");
  const std::string checked = mesh::checked_script(block, "m.geo");
  EXPECT_EQ(std::count(checked.begin(), checked.end(), '\n'), std::count(block.begin(), block.end(), '\n'));
  EXPECT_EQ(checked.find("two halves"), std::string::npos);  // a comment
  EXPECT_NE(checked.find("h > 10 && h <= 30"), std::string::npos);
}

TEST(Scripts, CommandsThatReachOutsideAreRefusedWithTheirLine) {
  // Programs, files, the end of the program, waiting, other options: by name, on the line where they stand, wherever that is.
  for (const std::string line :
       {"SystemCall \"id\";", "NonBlockingSystemCall \"id\";", "OnelabRun(\"a\", \"id\");", "Save \"x.msh\";", "Print \"x.png\";", "CreateDir \"x\";",
        "Include \"/etc/hostname\";", "Merge \"x.pos\";", "Exit;", "Abort;", "Sleep 100;", "Plugin(Eval).Run;", "Printf(\"x\") > \"x\";",
        "Printf(\"x\") >> \"x\";", "Field[1] = ExternalProcess;", "Field[1].CommandLine = \"id\";", "Field[1].FileName = \"/etc/passwd\";",
        "a = GetEnv(\"HOME\");", "General.TmpFileName = \"x\";", "Solver.Executable0 = \"id\";", "View \"x\" { };", "Solver.AutoCheck = 1;",
        "If (0) SystemCall \"id\"; EndIf", "SystemCall /* */ \"id\";", "SystemCall\n\"id\";", "Unheard \"id\";", "x = 1; x \"id\";",
        "SystemCall = 1;"}) {
    const std::string found = verdict(block + line + "\n");
    EXPECT_NE(found.find("m.geo:17:"), std::string::npos) << line << " -> " << found;
    EXPECT_NE(found.find("error: "), std::string::npos) << line;
  }
}

TEST(Scripts, WhatEndsATextOrAScriptOtherwiseIsRefused) {
  // Quotes, comments and characters that another reader might take in another way do not pass.
  for (const std::string line : {"a = \"x\\\";", "a = \"x", "a = 'x\"';", "/* no end", "a = `id`;", "a = 1; \x01", "a = \"\x1b[2J\";"})
    EXPECT_NE(verdict(line + "\n"), "") << line;
  EXPECT_EQ(verdict("a = Str('plain');\n"), "");
  EXPECT_EQ(mesh::checked_script("a = Str('plain');\n", "m.geo"), "a = Str(\"plain\");\n");
}

TEST(Scripts, LoopsWithoutEndAreRefused) {
  // A step of zero, written or computed, too many turns, also of loops inside one another, a loop variable that is set back, and
  // macros that call themselves.
  for (const std::string line :
       {"For i In {1:2:0}\nEndFor", "For i In {1:1e12}\nEndFor", "s = 2 - 2;\nFor i In {1:n:s}\nEndFor", "For (0:1e9)\nEndFor",
        "For i In {1:2000}\nFor j In {1:2000}\nx = 1;\nEndFor\nEndFor", "For i In {1:3}\ni = 1;\nEndFor", "Macro A\nCall A;\nReturn",
        "Macro A\nCall B;\nReturn\nMacro B\nCall A;\nReturn"})
    EXPECT_NE(verdict("n = 5;\n" + line + "\n"), "") << line;
  EXPECT_EQ(verdict("n = 5;\nFor i In {1:n:2}\nFor j In {n:1:-1}\nx = i;\nEndFor\nEndFor\n"), "");
}

TEST(Scripts, LongOnesAreCheckedInTime) {
  // Brackets in brackets, statements without end and many words take no more than their number.
  std::string nested, open, flat;
  for (int n = 0; n < 200'000; ++n) nested += "a(", open += "a = 1 + ", flat += "p = 1; ";
  for (const std::string& script : {nested, open, flat}) {
    const auto start = std::chrono::steady_clock::now();
    verdict(script);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10.0);
  }
}

TEST(Contained, CrashesHangsAndGreedAreTold) {
  // Work in the other process that ends, crashes, hangs or asks for more than it may have leaves this one as it was.
  using End = mesh::Contained::End;
  mesh::Limits limits;
  limits.seconds = 1.0;
  EXPECT_EQ(mesh::contained([] { return std::string("fine"); }, limits).output, "fine");
  const auto crash = mesh::contained([]() -> std::string { std::abort(); }, limits);
  EXPECT_EQ(crash.end, End::died);
  EXPECT_EQ(crash.signal, SIGABRT);
  EXPECT_EQ(mesh::contained([]() -> std::string { for (;;) std::this_thread::sleep_for(std::chrono::seconds(1)); }, limits).end, End::out_of_time);
  EXPECT_EQ(mesh::contained([]() -> std::string { return std::string(std::size_t{3} << 30, 'x'); }, limits).end, End::died);
  EXPECT_EQ(mesh::contained([]() -> std::string { std::_Exit(0); }, limits).end, End::died);
}

TEST(Contained, NothingIsStartedAndNothingIsWritten) {
  // In the sandbox neither a program starts nor a file is written, here or elsewhere, nor is one removed.
  const fs::path file = fs::temp_directory_path() / ("snug-contained-" + std::to_string(::getpid()));
  std::ofstream(file) << "mine";
  const auto result = mesh::contained(
      [&] {
        const bool ran = std::system(("echo ran > " + file.string()).c_str()) == 0;
        std::ofstream(file.string() + "-new") << "x";
        std::ofstream("here") << "x";
        std::error_code refused;
        fs::remove(file, refused);
        return std::string(ran || fs::exists("here") || fs::exists(file.string() + "-new") ? "harm" : "none");
      },
      {});
  EXPECT_EQ(result.output.substr(0, 4), "none");
  std::string content;
  std::ifstream(file) >> content;
  EXPECT_EQ(content, "mine");
  fs::remove(file);
}

/// A block that stands on its lower face and bears its own weight.
class Imported : public Attack {
 protected:
  void body(const std::string& name, const std::string& content) const {
    put("c/case.toml",
        "title = \"a block\"\n[body]\nkind = \"imported\"\nmesh = \"body/" + name + "\"\nunit = \"1 mm\"\n"
        "layers = [ { name = \"tissue\", material = \"relaxed thigh\" } ]\n[load]\ngravity = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]\n"
        "[[support]]\non = \"floor\"\nx = \"0 mm\"\ny = \"0 mm\"\nz = \"0 mm\"\n");
    put("c/body/" + name, content);
  }
};

TEST_F(Imported, AScriptOfGeometryIsMeshed) {
  // The same script as above through the program.
  body("m.geo", standing);
  const Outcome outcome = snug("check c");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("tissue"), std::string::npos);
}

TEST_F(Imported, OnlyTheHeaderMakesAMesh) {
  // Script text in a file called .msh, .pos or without ending is not run.
  for (const std::string name : {"m.msh", "m.pos", "m", "m.geo_unrolled", "m.MSH"}) {
    body(name, "SystemCall \"touch ran\";\nPrintf(\"x\") > \"ran\";\n");
    const Outcome outcome = bounded("check c");
    EXPECT_EQ(outcome.status, 2) << name << outcome.text;
    EXPECT_NE(outcome.text.find("body/" + name), std::string::npos) << outcome.text;
    EXPECT_FALSE(there("ran") || there("c/ran") || there("c/body/ran"));
    fs::remove_all(folder_ / "c");
  }
}

TEST_F(Imported, OptionFilesBesideAMeshAreNotRead) {
  // A clean script with an option file that would run a command.
  body("m.geo", standing);
  for (const std::string option : {"m.geo.opt", "m.opt", ".gmshrc", ".gmsh-options"})
    put("c/body/" + option, "SystemCall \"touch " + (folder_ / "ran").string() + "\";\n");
  EXPECT_EQ(snug("check c").status, 0);
  EXPECT_FALSE(there("ran"));
}

TEST_F(Imported, GmshsErrorsAreTheInputs) {
  // A misspelt command, a mesh that is cut short and one that is compressed: status 2, with the file and the line where there is one.
  body("m.geo", block + "Boxx(9) = {0,0,0};\n");
  Outcome outcome = bounded("check c");
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("m.geo:17:"), std::string::npos) << outcome.text;
  const std::string mesh = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 8 1 8\n3 1 0 8\n1\n2\n";
  body("m.msh", mesh);
  outcome = bounded("check c");
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("m.msh:4:"), std::string::npos) << outcome.text;
  body("m.msh", "\x1f\x8b\x08 compressed");
  EXPECT_EQ(bounded("check c").status, 2);
  body("m.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 99999999999 1 99999999999\n3 1 0 99999999999\n1\n$EndNodes\n");
  outcome = bounded("check c");
  EXPECT_EQ(outcome.status, 2) << outcome.text;
}

TEST_F(Imported, ScriptsMayDoMoreForThoseWhoSaySo) {
  // --allow-scripts: an included file is read.
  body("m.geo", "Include \"size.txt\";\n" + standing);
  put("c/body/size.txt", "ready = 1;\n");
  EXPECT_EQ(snug("check c").status, 2);
  const Outcome outcome = snug("check c --allow-scripts");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

}  // namespace
}  // namespace snug

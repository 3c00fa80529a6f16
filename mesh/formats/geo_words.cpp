#include "mesh/formats/geo_words.hpp"

#include <algorithm>
#include <set>

#include "cases/input/diagnostics.hpp"
#include "cases/input/text.hpp"

namespace snug::mesh {

namespace {

bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Walks over a script and keeps the place.
class Scanner {
 public:
  Scanner(const std::string& script, const std::string& file) : text_(script), file_(file) {}

  std::vector<GeoToken> operator()() {
    while (skip_blanks(), at_ < text_.size()) {
      token_ = {GeoWord::sign, "", line_, column()};
      if (starts_name(here()))
        read_name();
      else if (input::is_digit(here()) || (here() == '.' && input::is_digit(ahead())))
        read_number();
      else if (here() == '"' || here() == '\'')
        read_text(here());
      else
        read_sign();
      tokens_.push_back(token_);
    }
    return std::move(tokens_);
  }

 private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  char ahead() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\0'; }
  int column() const { return static_cast<int>(at_ - line_begin_) + 1; }
  [[noreturn]] void refuse(const std::string& found, const std::string& remedy) const {
    throw input::InputError({file_, line_, column()}, found, remedy);
  }

  void step() {
    if (here() == '\n') ++line_, line_begin_ = at_ + 1;
    ++at_;
  }

  void skip_blanks() {
    while (at_ < text_.size()) {
      if (here() == ' ' || here() == '\t' || here() == '\r' || here() == '\n') {
        step();
      } else if (here() == '/' && ahead() == '/') {
        while (at_ < text_.size() && here() != '\n') step();
      } else if (here() == '/' && ahead() == '*') {
        skip_comment();
      } else {
        return;
      }
    }
  }

  void skip_comment() {
    const auto end = text_.find("*/", at_ + 2);
    if (end == std::string::npos) refuse("a comment without end", "end it with */");
    while (at_ < end + 2) step();
  }

  void read_name() {
    token_.kind = GeoWord::name;
    while (starts_name(here()) || input::is_digit(here())) token_.text += here(), ++at_;
  }

  void read_number() {
    token_.kind = GeoWord::number;
    while (input::is_digit(here()) || here() == '.') token_.text += here(), ++at_;
    if ((here() == 'e' || here() == 'E') && (input::is_digit(ahead()) || ahead() == '+' || ahead() == '-')) {
      token_.text += here(), ++at_;
      token_.text += here(), ++at_;
      while (input::is_digit(here())) token_.text += here(), ++at_;
    }
  }

  void read_text(char quote) {
    token_.kind = GeoWord::text;
    for (++at_; here() != quote; ++at_) {
      if (at_ >= text_.size() || here() == '\n') refuse("a text that does not end on its line", "close its quotes");
      if (here() == '\\' || here() == '"' || here() == '\'' || (static_cast<unsigned char>(here()) < ' ' && here() != '\t'))
        refuse("a character in a text that gmsh does not take as it is", "leave quotes, backslashes and control characters out");
      token_.text += here();
    }
    ++at_;
  }

  void read_sign() {
    static const std::string signs = "()[]{}<>=+-*/%^,;:.!?|&#~@$";
    if (signs.find(here()) == std::string::npos) refuse("a character that stands in no gmsh script", "give a script as gmsh writes it, as text");
    token_.text = here();
    ++at_;
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 1;
  GeoToken token_{GeoWord::sign, ""};
  std::vector<GeoToken> tokens_;
};

}  // namespace

std::vector<GeoToken> geo_tokens(const std::string& script, const std::string& file) { return Scanner(script, file)(); }

bool is_geometry_command(const std::string& name) {
  static const std::set<std::string> words = {
      // numbers
      "Acos", "ArcCos", "Asin", "ArcSin", "Atan", "ArcTan", "Atan2", "ArcTan2", "Ceil", "Cos", "Cosh", "Exp", "Fabs", "Abs", "Floor",
      "Fmod", "Hypot", "Log", "Log10", "Max", "Min", "Modulo", "Pi", "Rand", "Round", "Sin", "Sinh", "Sqrt", "Step", "Tan", "Tanh",
      "List", "LinSpace", "LogSpace", "Unique", "Exists", "StrCmp", "StrFind", "StrLen",
      // texts, for names
      "Str", "StrCat", "StrPrefix", "StrRelative", "StrReplace", "StrSub", "Sprintf", "UpperCase", "LowerCase", "LowerCaseIn",
      // flow
      "If", "ElseIf", "Else", "EndIf", "For", "EndFor", "In", "Macro", "Function", "Return", "Call", "Printf", "Error", "Warning",
      // parameters
      "DefineConstant", "DefineNumber", "DefineString", "UndefineConstant", "SetNumber", "SetString", "Name", "Label", "Choices",
      "Highlight", "Visible", "Closed", "Help", "Units", "AutoCheck", "ReadOnly", "ReadOnlyRange", "Range",
      // new tags
      "newp", "newl", "newc", "newll", "newcl", "news", "newsl", "newv", "newreg", "newf", "newpt",
      // geometry
      "SetFactory", "SetMaxTag", "Point", "Points", "PointsOf", "Line", "Lines", "Curve", "Curves", "Loop", "LineLoop", "Circle",
      "Ellipse", "Ellipsis", "Spline", "BSpline", "Bezier", "Nurbs", "Knots", "Order", "Parametric", "Wire", "Plane", "Surface",
      "Surfaces", "Ruled", "Rectangle", "Disk", "Filled", "Filling", "Volume", "Volumes", "Sphere", "PolarSphere", "Box", "Cylinder",
      "Cone", "Wedge", "Torus", "Euclidian", "Coordinates", "ThruSections", "Fillet", "Chamfer", "Extrude", "Translate", "Rotate",
      "Symmetry", "Dilate", "Affine", "Duplicata", "Delete", "Recursive", "Coherence", "Compound", "Boundary", "CombinedBoundary",
      "BoundingBox", "Intersect", "Split", "Using", "Wires", "With", "Physical", "Parent", "Color", "Hide", "Show", "Degenerated",
      "BooleanUnion", "BooleanIntersection", "BooleanDifference", "BooleanFragments", "BooleanSection", "Object", "Tool",
      "CenterOfMass", "MatrixOfInertia", "Mass", "Closest", "HealShapes",
      // mesh
      "Mesh", "Geometry", "General", "Characteristic", "Length", "MeshSize", "MeshAlgorithm", "MeshSizeFromBoundary", "Transfinite",
      "TransfQuadTri", "Recombine", "Layers", "Hole", "Progression", "Bump", "Beta", "Power", "Left", "Right", "Alternate",
      "AlternateLeft", "AlternateRight", "Smoother", "Reverse", "ReverseMesh", "RelocateMesh", "Relocate", "Periodic", "Embedded",
      "QuadTriAddVerts", "QuadTriNoNewVerts", "QuadTriDbl", "QuadTriSngl", "RecombLaterals", "ScaleLast", "SetOrder", "RefineMesh",
      "OptimizeMesh", "RecombineMesh", "AdaptMesh", "Optimize", "ClassifySurfaces", "CreateTopology", "CreateGeometry",
      // fields of mesh sizes
      "Field", "Background", "BoundaryLayer", "Attractor", "AttractorAnisoCurve", "Distance", "Threshold", "Ball", "Frustum", "MathEval",
      "MathEvalAniso", "MinAniso", "IntersectAniso", "Restrict", "Constant", "Extend", "Curvature", "Gradient", "Laplacian", "Mean",
      "MaxEigenHessian", "Param", "LonLat", "Octree"};
  return words.count(name) != 0;
}

bool reaches_outside(const std::string& name) {
  static const std::set<std::string> words = {
      "SystemCall", "System", "NonBlockingSystemCall", "NonBlockingSystem", "OnelabRun", "OnelabAction", "RunOnelab", "ExternalProcess", "CommandLine",
      "Save", "SaveAll", "Print", "CreateDir", "Include", "Merge", "MergeFile", "MergeWithBoundingBox", "Open", "Read", "Write",
      "Exit", "Abort", "Quit", "Sleep", "Plugin", "View", "Views", "PostView", "Structured", "Combine", "Draw", "SetChanged", "Solver",
      "PostProcessing", "Parse", "ParseString", "Homology", "Cohomology", "Betti", "GmshOption", "GmshOptions", "FileName", "PathName",
      "ListFromFile", "FileExists", "GetEnv", "GetValue", "GetStringValue", "GetString", "GetNumber", "GetForced", "GetForcedStr",
      "DirName", "AbsolutePath", "FixRelativePath", "CurrentDirectory", "CurrentDir", "CurrentFileName", "GMSH_EXECUTABLE_NAME", "OnelabClient",
      "ServerAction", "Macros", "DimNameSpace", "NameToString", "StringToName", "NameFromString", "N2S", "S2N", "StringFromName", "TestLevel",
      "SyncModel", "NewModel", "ShowOptions", "Window", "Alias", "AliasWithOptions", "Run", "AutomaticMeshSizeField", "PythonCommand"};
  return words.count(name) != 0;
}

}  // namespace snug::mesh

#include "tests/fuzz/targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "cases/input/csv.hpp"
#include "cases/input/table.hpp"
#include "mesh/body/foreign.hpp"
#include "mesh/formats/curve_set.hpp"
#include "mesh/formats/geo_script.hpp"
#include "mesh/formats/gmsh_file.hpp"
#include "mesh/formats/triangle_surface.hpp"
#include "mesh/pattern/drawing.hpp"
#include "mesh/pattern/dxf_pattern.hpp"
#include "mesh/pattern/garmentcode.hpp"
#include "mesh/pattern/svg_pattern.hpp"
#include "mesh/pattern/toml_pattern.hpp"
#include "postproc/comfort/curve_fit.hpp"
#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/fuzzy_file.hpp"
#include "postproc/comfort/membership_fit.hpp"
#include "postproc/febio_log.hpp"
#include "postproc/frd_listing.hpp"
#include "postproc/grid.hpp"
#include "postproc/listing_reader.hpp"
#include "postproc/nodal_field.hpp"
#include "postproc/report/page.hpp"
#include "tests/fuzz/texts.hpp"

namespace snug::fuzz {

namespace fs = std::filesystem;

namespace {

/// Texts of tests/fuzz/corpus/NAME.
std::vector<std::string> corpus(const std::string& name) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(SNUG_SOURCE_DIR) / "tests/fuzz/corpus" / name)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(text_of(file).substr(0, longest));
  return texts;
}

/// Readers of grids and of gmsh's files.
std::vector<Target> mesh_targets() {
  const auto vtu = [](const fs::path& file, const std::string& text) {
    put(with_ending(file, ".vtu"), text);
    postproc::read_field(with_ending(file, ".vtu"), {});
  };
  const auto pvd = [](const fs::path& file, const std::string& text) {
    put(file, text);
    postproc::read_series(file);
  };
  const auto gmsh = [](const char* ending) {
    return [ending](const fs::path& file, const std::string& text) {
      put(with_ending(file, ending), text);
      mesh::GmshOptions options;
      options.limits.seconds = 4.0;
      mesh::read_gmsh_file(with_ending(file, ending), options);
    };
  };
  const auto summary = [](const fs::path& file, const std::string& text) {
    const fs::path folder = with_ending(file, ".out");
    fs::create_directories(folder);
    put(folder / "summary.json", text);
    postproc::report::page(folder, {{}, "none"});
  };
  return {
      {"vtu", vtu, corpus("vtu"), {"NumberOfPoints=\"", "NumberOfCells=\"1", "offset=\"", "Float64", "Int64", "99999999999", "<DataArray ", "/>", "\"", "<"}},
      {"pvd", pvd, corpus("pvd"), {"<DataSet ", "timestep=\"", "file=\"", "../", "/", "nan", "1e999", "\"", ">", "\n"}},
      {"msh", gmsh(".msh"), corpus("msh"), {"$Nodes\n", "$EndNodes\n", "$Elements\n", "$EndElements\n", "99999999999", "-1", "0 ", "1e999", "nan", "\n"}},
      {"geo", gmsh(".geo"), corpus("geo"), {"For ", "EndFor\n", "{", "}", "Physical ", "Volume", "= ", "Mesh.", "1e999", ";\n", "//", "\"", "Save \"x\";", "~{1}"}},
      {"summary", summary, corpus("summary"), {"null", "[]", "{}", "\"status\": ", "1e999", "-1", "\"", ",", ":", "true"}},
  };
}

/// Readers of curves and surfaces. What is read must also be drawn, written and read again.
std::vector<Target> curve_targets() {
  const auto used = [](mesh::CurveSet set) {
    if (mesh::curve_json(mesh::parse_curve_json(mesh::curve_json(set), "again")) != mesh::curve_json(set))
      throw std::logic_error("what is written is read as something else");
    std::erase_if(set.nets, [](const auto& net) { return net.shape.points.cols() > 1000; });
    mesh::curve_svg(set, {.subdivisions = 2});
  };
  const auto json = [used](const fs::path&, const std::string& text) { used(mesh::parse_curve_json(text, "fuzz")); };
  const auto dxf = [used](const fs::path&, const std::string& text) {
    std::string left_out;
    used(mesh::parse_dxf_splines(text, "fuzz", left_out));
  };
  return {
      {"curvejson", json, corpus("curvejson"), {"[", "]", "{", "}", ",", ":", "\"degree\": ", "\"knots\": [", "\"closed\": [true, true]", "1e999", "1e308", "-0", "null", "\\u0000", "\n"}},
      {"curvedxf", dxf, corpus("curvedxf"), {"0\nSPLINE\n", "40\n", "41\n", "10\n", "71\n", "$INSUNITS\n70\n", "1e308", "nan", "-1", "\r\n", "\n", "0\nSECTION\n2\nENTITIES\n"}},
  };
}

std::vector<Target> text_targets() {
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
    input::MaterialEntry reference;
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
      spec.kind = input::BodyKind::imported, spec.mesh = "fuzz";
      mesh::body_of(model, spec);
    };
  };
  return {
      {"apdl",
       model_by([](const std::string& text, const std::string& file, input::Diagnostics& diagnostics) { return mesh::parse_apdl(text, file, diagnostics, 1); }),
       {text_of(models / "double_pyramid.txt"), text_of(models / "block.cdb"),
        "et,1,185\net,2,154\nmp,ex,1,4\nk0=2\n*do,i,0,1\nn,1+4*i,0,0,i*k0\nn,2+4*i,1,0,i*k0\nn,3+4*i,1,1,i*k0,30\nn,4+4*i,0,1,i*k0\n*enddo\nn,9,.5,.5,3\nn,10,0,2,0\nn,11,0,2,2\n"
        "e,1,2,3,4,5,6,7,8\ne,5,6,7,8,9,9,9,9\ne,4,3,10,10,8,7,11,11\ntype,2\ne,1,2,6,5\nsfe,4,1,pres,,1\nf,5,fz,1\nf,6,fz,1\nf,7,fz,1\nf,8,fz,1\nd,1,all\nd,2,all\nd,3,all\n"},
       {"NBLOCK,6,SOLID\n", "EBLOCK,19,SOLID\n", "CMBLOCK,A,NODE,3\n(8i10)\n", "RLBLOCK,1,1,6,7\n", "(3i9,6e21.13e3)\n", "esize,,3\n",
        "d,all,all\n", "nsel,s,loc,x,0,1\n", "$", "!", ",", "\n", "-1\n", "99999999", "e,1,2,3,4\n", "a,1,2,3\n", "1e999", "*do,j,1,3\n", "*enddo\n", "*if,k0,eq,2,then\n", "*else\n",
        "*endif\n", "en,r5.5,attr,20,1,1,1,1,0,7\n", "en,r5.5,node,,", "0,0,0,0", "csys,1\n", "emore,0,0\n", "solve\n", "lswrite\n", "fdele,all,all\n", "ddele,1,ux\n", "sfedele,all\n", "lsclear,all\n"}},
      {"inp",
       model_by([](const std::string& text, const std::string& file, input::Diagnostics& diagnostics) { return mesh::parse_calculix(text, file, diagnostics); }),
       {text_of(models / "cube.inp"),
        "*PART, NAME=P\n*NODE, NSET=A, SYSTEM=C\n1,0,0,0\n2,1,0,0\n3,1,90,0\n4,0,0,1\n5,1,0,1\n6,1,90,1\n*ELEMENT, TYPE=C3D6, ELSET=E\n1, 1,2,3,4,5,6\n*ELEMENT, TYPE=CPS3, ELSET=F\n2, 1,2,3\n"
        "*INSTANCE, NAME=I, PART=P\n1,0,0\n*NSET, NSET=T\n4,5,6\n*TRANSFORM, NSET=T, TYPE=C\n0,0,0,0,0,1\n*SURFACE, NAME=S\nE, S2\n*MATERIAL, NAME=M\n*HYPERELASTIC, YEOH\n1,1,1,.1\n"
        "*SOLID SECTION, ELSET=E, MATERIAL=M\n*BOUNDARY\n1, ENCASTRE\n*STEP\n*STATIC\n*CLOAD\nT,3,1.\n*DSLOAD\nS,P,1.\n*END STEP\n*STEP\n*CLOAD, OP=NEW\nT,1,2.\n*END STEP\n"},
       {"*ELEMENT, TYPE=S6, ELSET=E\n", "*NSET, NSET=N, GENERATE\n", "*SHELL SECTION, ELSET=E, MATERIAL=M\n", "*", "**", ",", "\n", "=",
        "99999999", "1e999", "*DLOAD\n", "*ELASTIC\n", "*HYPERELASTIC, OGDEN, N=3\n", "*INCLUDE, INPUT=a.inp\n",
        "*AMPLITUDE, NAME=A\n0,0,1,1\n", "*ELEMENT, TYPE=C3D13, ELSET=E\n", "*TRANSFORM, NSET=T, TYPE=R\n1,0,0,0,1,0\n", "*STEP\n"}},
      {"feb",
       model_by([](const std::string& text, const std::string& file, input::Diagnostics& diagnostics) { return mesh::parse_febio(text, file, diagnostics); }),
       {"<febio_spec version=\"4.0\"><Module type=\"solid\"/><Material><material id=\"1\" name=\"m\" type=\"neo-Hookean\"><E>1</E><v>0.3</v></material></Material>"
        "<Mesh><Nodes name=\"N\"><node id=\"1\">0,0,0</node><node id=\"2\">1,0,0</node><node id=\"3\">0,1,0</node><node id=\"4\">0,0,1</node></Nodes>"
        "<Elements type=\"tet4\" name=\"P\"><elem id=\"1\">1,2,3,4</elem></Elements><NodeSet name=\"s\">1,2,3</NodeSet><Surface name=\"f\"><tri3 id=\"1\">1,3,2</tri3></Surface></Mesh>"
        "<MeshDomains><SolidDomain name=\"P\" mat=\"m\"/></MeshDomains><Boundary><bc type=\"zero displacement\" node_set=\"s\"><x_dof>1</x_dof></bc>"
        "<bc type=\"prescribed displacement\" node_set=\"N\"><dof>z</dof><value lc=\"1\">0.1</value></bc></Boundary><Loads><surface_load type=\"pressure\" surface=\"f\"><pressure lc=\"1\">1</pressure></surface_load>"
        "<nodal_load type=\"nodal_force\" node_set=\"s\"><value>0,0,1</value></nodal_load></Loads><LoadData><load_controller id=\"1\" type=\"loadcurve\"><points><pt>0,0</pt><pt>1,1</pt></points></load_controller></LoadData>"
        "<Step><step id=\"1\"><Control><time_steps>10</time_steps><step_size>0.1</step_size></Control></step></Step></febio_spec>"},
       {"<", ">", "/>", "</Mesh>", "hex8", "hex27", "\"", "&amp;", "1e999", "99999999999", "lc=\"2\"", "<Contact><a/></Contact>", "<quad4>1,2,3,4</quad4>", "<!--", "<![CDATA[", "tri6", ","}},
      {"frd",
       [](const fs::path&, const std::string& text) {
         input::Diagnostics diagnostics;
         const auto tables = postproc::frd_tables(text, "fuzz", diagnostics);
         diagnostics.throw_if_any();
         if (tables) postproc::field_of(*tables, {});
       },
       {"    1C\n    2C                             2                                     1\n -1         1 0.00000E+00 0.00000E+00 0.00000E+00\n -1         2 3.00000E+01 0.00000E+00 0.00000E+00\n -3\n"
        "    1PSTEP                         1           1           1\n  100CL  101 1.000000000           2                     0    1           1\n -4  DISP        4    1\n -5  D1          1    2    1    0\n"
        " -5  D2          1    2    2    0\n -5  D3          1    2    3    0\n -5  ALL         1    2    0    0    1ALL\n -1         1-6.46343E-02 0.00000E+00 0.00000E+00\n -1         2 1.E0\n -3\n 9999\n"},
       {" -1", " -2", " -3\n", " -4  STRESS      6    1\n", " -5  SXX         1    4    1    1\n", "    3C", "    2C", "\n", "1.00000E+00", "-1.0000E+100", "*", "NaN"}},
      {"febiolog",
       [](const fs::path&, const std::string& text) {
         input::Diagnostics diagnostics;
         const auto tables = postproc::febio_records(text, "fuzz", diagnostics);
         diagnostics.throw_if_any();
         if (tables) postproc::field_of(*tables, {});
       },
       {"Data Record #1\n=====\nStep = 1\nTime = 0.5\nData = displacement\n3 0.25 0 -1.5e-05\n7 -2 1 1\n", "*Step  = 4\n*Time  = 0.1\n*Data  = uz;ux\n1,0.5,-1\n12,2,3\n"},
       {"*Step = ", "*Time = ", "*Data = ux;uy;uz\n", "\n", "\n\n", ",", "1e999", "nan", "-", "99999999999 "}},
      {"listing",
       listing,
       {text_of(listings / "shell_displacement.lis"), text_of(listings / "shell_stress.lis"),
        text_of(listings / "ansys_pages.lis")},
       {"NODE", "VALUE", " MINIMUM VALUES\n", "\n", "E-011", "E+060.", "-101", "************", ".....", "TOP/BOTTOM",
        "NaN", "  ELEMENT=       1\n", " PRINT S\n", "1\n", "99999999999", "\t"}},
      {"csv",
       curves,
       {text_of(source / "postproc/data/wear_trial_2002.csv"), "pressure (kPa);rating;location\n1,5;2;calf\n2,25;3,5;calf\n;;\n"},
       {";", "\t", "\r", "\xFF\xFE", std::string("a\0b\0", 4), "(kPa)", ",", "\"", "[mm]", "\n", "#", "1e400", "nan"}},
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

/// Sewing patterns. One that is read must also be checked, and where it is sound drawn, written, read again and meshed.
std::vector<Target> pattern_targets() {
  const auto pattern_by = [](auto parse) {
    return [parse](const fs::path&, const std::string& text) {
      const mesh::CheckedPattern checked = mesh::checked(parse(text));
      mesh::drawing_svg(checked);
      mesh::checked(mesh::parse_garmentcode(mesh::garmentcode_text(checked), "written"));
      double largest = 0.0;
      for (const mesh::Piece& piece : checked.pattern.pieces) largest = std::max(largest, mesh::box(piece).sizes().maxCoeff());
      mesh::mesh_pattern(checked, largest / 8.0);
    };
  };
  const fs::path patterns = fs::path(SNUG_SOURCE_DIR) / "tests/data/patterns";
  const std::string skirt = text_of(patterns / "skirt.toml");
  const mesh::CheckedPattern drawn = mesh::checked(mesh::parse_toml_pattern(skirt, "skirt"));
  return {
      {"pattern", pattern_by([](const std::string& text) { return mesh::parse_toml_pattern(text, "fuzz"); }), {skirt},
       {"[[piece]]\n", "[[seam]]\n", "kind = \"arc\", ", "kind = \"spline\", ", "through = [[1, 2]], ", "[0..0.5]", " + ", "-1", "1e999", "1e-9", "mirror_of = \"front\"\n", "0, 0"}},
      {"garmentcode", pattern_by([](const std::string& text) { return mesh::parse_garmentcode(text, "fuzz"); }), {mesh::garmentcode_text(drawn)},
       {"{", "}", "[", "]", "null", "1e308", "-1", "\"circle\"", "\"edges\": [0, 1]", "\"translation\": [0, 0, 1], \"rotation\": [0, 90, 0], ", "true", "0.0"}},
      {"dxf", pattern_by([](const std::string& text) { return mesh::parse_dxf(text, "fuzz"); }), {text_of(patterns / "tube.dxf")},
       {"  0\n", "POLYLINE\n", "VERTEX\n", " 42\n1.0\n", "SEQEND\n", "BLOCK\n", "LWPOLYLINE\n", "SPLINE\n", "HATCH\n", "MTEXT\n", "999999999", "-1", "1e999", "\n", "  8\n14\n"}},
      {"svg", pattern_by([](const std::string& text) { return mesh::parse_svg(text, "fuzz"); }), {mesh::drawing_svg(drawn)},
       {"<path d=\"", "\"/>", "<g transform=\"rotate(", "matrix(1 2 3 4 5 6)", " A 1 1 0 0 1 ", " Z ", "M 0 0 ", "1e999", "-", "</g>", "&#0;", "class=\"outline\""}},
  };
}

bool has_place(const input::InputError& error) {
  for (const input::Diagnostic& one : error.errors())
    if (one.where.file.empty()) return false;
  return true;
}

}  // namespace

std::vector<Target> targets() {
  std::vector<Target> all = text_targets();
  for (Target& target : mesh_targets()) all.push_back(std::move(target));
  for (Target& target : curve_targets()) all.push_back(std::move(target));
  for (Target& target : library_targets()) all.push_back(std::move(target));
  for (Target& target : pattern_targets()) all.push_back(std::move(target));
  for (Target& target : garment_targets()) all.push_back(std::move(target));
  return all;
}

bool takes(const Target& target, const fs::path& file, const std::string& text, std::string& what) {
  try {
    target.read(file, text);
  } catch (const input::InputError& error) {
    if (has_place(error)) return true;
    what = std::string("no place: ") + error.what();
    return false;
  } catch (const std::exception& error) {
    what = error.what();
    return false;
  } catch (...) {
    what = "something that is no exception";
    return false;
  }
  return true;
}

}  // namespace snug::fuzz

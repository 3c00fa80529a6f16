#include "mesh/cad/cad_file.hpp"

#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESSolid_Protocol.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "cases/input/files.hpp"
#include "mesh/cad/occt_shapes.hpp"
#include "mesh/formats/contained.hpp"

namespace snug::mesh {

namespace fs = std::filesystem;

namespace {

using input::InputError;

bool is_iges(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".iges" || ending == ".igs";
}

std::string product_of(const Handle(Standard_Transient) & root) {
  const auto definition = Handle(StepBasic_ProductDefinition)::DownCast(root);
  if (definition.IsNull() || definition->Formation().IsNull() || definition->Formation()->OfProduct().IsNull())
    return {};
  const Handle(TCollection_HAsciiString) name = definition->Formation()->OfProduct()->Name();
  return name.IsNull() ? std::string() : std::string(name->ToCString());
}

/// Reads every root by itself, so that each keeps its name.
template <class Reader>
CurveSet read_by(Reader&& reader, const std::string& file) {
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) throw std::runtime_error("OpenCASCADE cannot read it");
  CurveSet set;
  for (int root = 1; root <= reader.NbRootsForTransfer(); ++root) {
    reader.ClearShapes();
    if (!reader.TransferOneRoot(root)) continue;
    for (int shape = 1; shape <= reader.NbShapes(); ++shape)
      add_shape(reader.Shape(shape), product_of(reader.RootForTransfer(root)), set);
  }
  return set;
}

/// "+" and JSON of what was found, or "-" and why not.
std::string read_here(const std::string& file, bool iges) {
  try {
    silence_occt();
    std::string found = "+";
    return found.append(curve_json(iges ? read_by(IGESControl_Reader(), file) : read_by(STEPControl_Reader(), file)));
  } catch (const Standard_Failure& failure) {
    return std::string("-OpenCASCADE: ") + failure.GetMessageString();
  } catch (const std::exception& error) {
    return std::string("-") + error.what();
  }
}

template <class Writer>
void use_all_digits(Writer& writer) {
  writer.FloatWriter().SetFormat("%.17E", Standard_True);
}

std::string step_text(const CurveSet& set) {
  STEPControl_Writer writer;
  const Handle(StepData_StepModel) model = writer.Model();
  const auto add = [&](const std::string& name, const auto& shape) {
    const int before = model->NbEntities();
    if (writer.Transfer(shape_of(shape), STEPControl_AsIs) != IFSelect_RetDone)
      throw Standard_Failure("a shape is not taken into STEP");
    for (int entity = before + 1; entity <= model->NbEntities();
         ++entity)  // OpenCASCADE numbers the names that it is given
      if (const auto product = Handle(StepBasic_Product)::DownCast(model->Value(entity)); !product.IsNull())
        product->SetName(new TCollection_HAsciiString(name.c_str()));
  };
  for (const auto& one : set.surfaces) add(one.name, one.shape);
  for (const auto& one : set.curves) add(one.name, one.shape);
  StepData_StepWriter text(model);
  use_all_digits(text);
  text.SendModel(Handle(StepData_Protocol)::DownCast(model->Protocol()));
  std::ostringstream out;
  text.Print(out);
  return out.str();
}

std::string iges_text(const CurveSet& set) {
  IGESControl_Writer writer("MM", 0);
  const auto add = [&](const auto& shape) {
    if (!writer.AddShape(shape_of(shape))) throw Standard_Failure("a shape is not taken into IGES");
  };
  for (const auto& one : set.surfaces) add(one.shape);
  for (const auto& one : set.curves) add(one.shape);
  writer.ComputeModel();
  IGESData_IGESWriter text(writer.Model());
  use_all_digits(text);
  text.SendModel(new IGESSolid_Protocol);
  std::ostringstream out;
  text.Print(out);
  return out.str();
}

}  // namespace

bool is_cad_file(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return is_iges(file) || ending == ".step" || ending == ".stp";
}

CurveSet read_cad_file(const fs::path& file) {
  input::read_file(file);  // says why, where it cannot be read
  const std::string path = fs::absolute(file).string();
  const Contained result = contained([&] { return read_here(path, is_iges(file)); }, {});
  const input::Location where{file.string(), 0, 0};
  if (result.end == Contained::End::out_of_time)
    throw InputError(where, "OpenCASCADE has not read it in five minutes", "export fewer shapes");
  if (result.end != Contained::End::done || result.output.empty())
    throw InputError(where, "OpenCASCADE ends while it reads the file", "export it again, or as JSON");
  if (result.output.front() == '-') throw InputError(where, result.output.substr(1), "export it again as STEP or IGES");
  CurveSet set = parse_curve_json(result.output.substr(1), file.string());
  if (set.empty()) throw InputError(where, "no curves and no surfaces", "export B-spline curves or surfaces");
  return set;
}

std::string cad_text(const CurveSet& set, const fs::path& file) {
  const input::Location where{file.string(), 0, 0};
  if (set.curves.empty() && set.surfaces.empty())
    throw InputError(where, "there is no curve and no surface to write", "nets and B-forms go to .json or .svg only");
  try {
    silence_occt();
    return is_iges(file) ? iges_text(set) : step_text(set);
  } catch (const Standard_Failure& failure) {
    throw InputError(where, std::string("OpenCASCADE: ") + failure.GetMessageString(), "write it as .json");
  } catch (const std::invalid_argument& fault) {  // of the clamped ends
    throw InputError(where, fault.what(), "write it as .json");
  }
}

}  // namespace snug::mesh

// Of a file with several load steps the one that is asked for, and nodes held along directions of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/body/foreign.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {
namespace {

using testing::ElementsAre, testing::HasSubstr, testing::IsEmpty, testing::SizeIs;

Model apdl_step(const std::string& text, int load_step = 0) {
  input::Diagnostics diagnostics;
  Model model = parse_apdl(text, "part.mac", diagnostics, load_step);
  diagnostics.throw_if_any();
  return model;
}

Model inp(const std::string& text, int load_step = 0) {
  input::Diagnostics diagnostics;
  Model model = parse_calculix(text, "part.inp", diagnostics, {}, {}, load_step);
  diagnostics.throw_if_any();
  return model;
}

template <class Read>
std::string fault(Read read) {
  try {
    read();
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

const std::string inp_body = "*NODE\n1,0,0,0\n2,3,0,0\n3,0,2,0\n4,0,0,4\n*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1,2,3,4\n*MATERIAL, NAME=M\n*HYPERELASTIC, NEO HOOKE\n2., 0.5\n"
                             "*SOLID SECTION, ELSET=E, MATERIAL=M\n*BOUNDARY\n1,1,3\n";
const std::string inp_steps = "*STEP, NLGEOM\n*STATIC\n*CLOAD\n4,1,1.5\n*DLOAD\n1,P3,0.2\n*END STEP\n"
                              "*STEP, NLGEOM\n*STATIC\n*CLOAD\n4,1,2.5\n3,2,7.\n*END STEP\n"
                              "*STEP, NLGEOM\n*STATIC\n*CLOAD, OP=NEW\n2,3,-4.\n*BOUNDARY\n2,2,2,0.1\n*FREQUENCY\n8\n*END STEP\n";

TEST(LoadSteps, OfAnInputDeckTheEndOfTheChosenStepIsTaken) {
  // By hand: step 1 pulls node 4; step 2 pulls it more and node 3, too, the pressure stays; the third, which could not be read, is passed over.
  const Model first = inp(inp_body + inp_steps, 1), second = inp(inp_body + inp_steps, 2);
  EXPECT_THAT(first.forces, ElementsAre(ModelForce{4, 0, 1.5}));
  EXPECT_THAT(second.forces, ElementsAre(ModelForce{4, 0, 2.5}, ModelForce{3, 1, 7.0}));
  EXPECT_THAT(second.pressures, ElementsAre(ModelPressure{1, 2, 0.2}));
  EXPECT_THAT(second.supports, SizeIs(3));
  ASSERT_THAT(second.remarks, SizeIs(1));
  EXPECT_THAT(second.remarks[0].found, HasSubstr("there are 3 steps: the loads and supports at the end of step 2"));
  EXPECT_EQ(second.remarks[0].where.line, 21);
  EXPECT_THAT(fault([] { inp(inp_body + inp_steps, 3); }), HasSubstr("*FREQUENCY"));
}

TEST(LoadSteps, AStepThatIsNotThereIsRefused) {
  const std::string error = fault([] { inp(inp_body + inp_steps.substr(0, inp_steps.rfind("*STEP")), 5); });
  EXPECT_THAT(error, HasSubstr("load step 5 is asked for, and there are 2"));
  EXPECT_THAT(error, HasSubstr("write load_step from 1 to 2"));
  EXPECT_THAT(fault([] { inp(inp_body, 2); }), HasSubstr("leave load_step out"));
  EXPECT_THAT(inp(inp_body, 1).remarks, IsEmpty());  // a deck without a step is its own first one
}

const std::string apdl_body = "et,1,285\nmp,ex,1,4.5\nmp,nuxy,1,0.2\nn,1,0,0,0\nn,2,3,0,0\nn,3,0,2,0\nn,4,0,0,4\ne,1,2,3,4\nnlgeom,on\nd,1,all,0\n";

TEST(LoadSteps, OfApdlTextSolveAndLswriteEndSteps) {
  // Step 1: two forces and a pressure; step 2: one of them is gone, one is another; step 3 has no pressure and another support.
  for (const char* end : {"solve\n", "lswrite\n"}) {
    const std::string text = apdl_body + "f,4,fx,1.5\nf,3,fy,7\nsfe,1,3,pres,,0.2\n" + end + "fdele,3,fy\nf,4,fx,2.5\n" + end + "sfedele,1,3,pres\nddele,1,uz\nd,2,uy,0.1\n" + end;
    const Model first = apdl_step(text, 1), second = apdl_step(text, 2), last = apdl_step(text);
    EXPECT_THAT(first.forces, testing::UnorderedElementsAre(ModelForce{4, 0, 1.5}, ModelForce{3, 1, 7.0})) << end;
    EXPECT_THAT(second.forces, ElementsAre(ModelForce{4, 0, 2.5}));
    EXPECT_THAT(second.pressures, SizeIs(1));
    EXPECT_EQ(std::count(second.supports.begin(), second.supports.end(), ModelSupport{1, 2, 0.0}), 1);
    EXPECT_THAT(last.pressures, IsEmpty());
    EXPECT_EQ(std::count(last.supports.begin(), last.supports.end(), ModelSupport{1, 2, 0.0}), 0);
    EXPECT_EQ(std::count(last.supports.begin(), last.supports.end(), ModelSupport{2, 1, 0.1}), 1);
    EXPECT_THAT(last.remarks.back().found, HasSubstr("there are 3 steps: the loads and supports at the end of the last one"));
    EXPECT_THAT(fault([&] { apdl_step(text, 4); }), HasSubstr("there are 3"));
  }
}

TEST(LoadSteps, SolvingWhatWasWrittenIsNoStepOfItsOwn) {
  const std::string text = apdl_body + "f,4,fx,1.5\nlswrite,1\nf,4,fx,2.5\nlswrite,2\nlssolve,1,2\nsolve\nfinish\n";
  EXPECT_THAT(fault([&] { apdl_step(text, 3); }), HasSubstr("there are 2"));
  EXPECT_THAT(apdl_step(text, 2).forces, ElementsAre(ModelForce{4, 0, 2.5}));
  EXPECT_THAT(apdl_step(apdl_body + "f,4,fx,1.5\nsolve\n").remarks, IsEmpty());
  EXPECT_THAT(apdl_step(apdl_body + "f,4,fx,1.5\nlsclear,fe\nd,1,all,0\nf,2,fz,3\nsolve\n").forces, ElementsAre(ModelForce{2, 2, 3.0}));
}

TEST(ObliqueSupports, NodesAmidOnesThatAreHeldAlongALineAreHeldToo) {
  // A linear brick of 2 x 1 x 3 cm whose end x = 2 is held along axes turned by 20 degrees about z at two nodes and by 30 at the other two: the middles of
  // edges between the same frames have theirs, that of the face lies between. Units: cm.
  const std::string text = "et,1,185\nmp,ex,1,4.5\nmp,nuxy,1,0.2\nn,1,0,0,0\nn,2,2,0,0,20\nn,3,2,1,0,30\nn,4,0,1,0\nn,5,0,0,3\nn,6,2,0,3,20\nn,7,2,1,3,30\nn,8,0,1,3\n"
                           "e,1,2,3,4,5,6,7,8\nnlgeom,on\nd,2,ux,0.05\nd,3,ux,0.05\nd,6,ux,0.05\nd,7,ux,0.05\nd,2,uz,0\n";
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "part.cdb", spec.unit = 1e-2;
  const BodyMesh body = body_of(apdl_step(text), spec);
  ASSERT_THAT(body.held_along, SizeIs(9));
  ASSERT_THAT(body.held, SizeIs(1));
  for (const HeldAlong& held : body.held_along) {
    const Eigen::Vector3d& at = body.nodes[held.node];
    EXPECT_NEAR(at.x(), 0.02, 1e-15);
    EXPECT_NEAR(held.displacement, 5e-4, 1e-15);
    EXPECT_NEAR(std::atan2(held.direction.y(), held.direction.x()) * 180.0 / M_PI, 20.0 + 10.0 * at.y() / 0.01, 1e-9);
  }
}

}  // namespace
}  // namespace snug::mesh

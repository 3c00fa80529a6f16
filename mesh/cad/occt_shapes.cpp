#include "mesh/cad/occt_shapes.hpp"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>

namespace snug::mesh {

using curves::BSplineCurve;
using curves::BSplineSurface;

namespace {

/// Knots and how often each is there.
struct Multiple {
  explicit Multiple(const std::vector<double>& flat) {
    for (const double knot : flat) {
      if (knots.empty() || knot != knots.back()) knots.push_back(knot), times.push_back(0);
      ++times.back();
    }
  }
  TColStd_Array1OfReal values() const { return {knots.front(), 1, static_cast<int>(knots.size())}; }
  TColStd_Array1OfInteger counts() const { return {times.front(), 1, static_cast<int>(times.size())}; }
  std::vector<double> knots;
  std::vector<int> times;
};

gp_Pnt millimetres(const Eigen::VectorXd& point) {
  return {point[0] / millimetre, point[1] / millimetre, point.size() > 2 ? point[2] / millimetre : 0.0};
}

template <class Column>
void put_metres(Column&& into, const gp_Pnt& point) {
  into << millimetre * point.X(), millimetre * point.Y(), millimetre * point.Z();
}

std::vector<double> flat(const TColStd_Array1OfReal& knots) { return {knots.begin(), knots.end()}; }

BSplineCurve ours(const Handle(Geom_BSplineCurve) & from) {
  if (from->IsPeriodic()) from->SetNotPeriodic();
  BSplineCurve curve{from->Degree(), flat(from->KnotSequence()), Eigen::MatrixXd(3, from->NbPoles()),
                     Eigen::VectorXd(from->NbPoles())};
  for (int i = 1; i <= from->NbPoles(); ++i) {
    put_metres(curve.points.col(i - 1), from->Pole(i));
    curve.weights[i - 1] = from->Weight(i);
  }
  return curve;
}

BSplineSurface ours(const Handle(Geom_BSplineSurface) & from) {
  if (from->IsUPeriodic()) from->SetUNotPeriodic();
  if (from->IsVPeriodic()) from->SetVNotPeriodic();
  BSplineSurface surface{
      {from->UDegree(), from->VDegree()}, {flat(from->UKnotSequence()), flat(from->VKnotSequence())}, {}, {}};
  const int rows = from->NbUPoles(), columns = from->NbVPoles();
  surface.points.resize(3, rows * columns), surface.weights.resize(rows * columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      put_metres(surface.points.col(i * columns + j), from->Pole(i + 1, j + 1));
      surface.weights[i * columns + j] = from->Weight(i + 1, j + 1);
    }
  return surface;
}

bool near(double a, double b) { return std::abs(a - b) <= Precision::PConfusion(); }

BSplineCurve curve_of(const TopoDS_Edge& edge) {
  double from = 0.0, to = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, from, to);
  const Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(curve);
  if (!spline.IsNull() && near(from, spline->FirstParameter()) && near(to, spline->LastParameter()))
    return ours(Handle(Geom_BSplineCurve)::DownCast(spline->Copy()));
  return ours(GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(curve, from, to)));
}

BSplineSurface surface_of(const TopoDS_Face& face) {
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0, a0 = 0.0, a1 = 0.0, b0 = 0.0, b1 = 0.0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  surface->Bounds(a0, a1, b0, b1);
  const Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (!spline.IsNull() && near(u0, a0) && near(u1, a1) && near(v0, b0) && near(v1, b1))
    return ours(Handle(Geom_BSplineSurface)::DownCast(spline->Copy()));
  return ours(GeomConvert::SurfaceToBSplineSurface(new Geom_RectangularTrimmedSurface(surface, u0, u1, v0, v1)));
}

}  // namespace

void silence_occt() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer)); }

TopoDS_Shape shape_of(const BSplineCurve& any) {
  const BSplineCurve curve = any.clamped();
  const int count = static_cast<int>(curve.points.cols());
  TColgp_Array1OfPnt poles(1, count);
  TColStd_Array1OfReal weights(1, count);
  for (int i = 0; i < count; ++i) poles(i + 1) = millimetres(curve.points.col(i)), weights(i + 1) = curve.weights[i];
  const Multiple knots(curve.knots);
  return BRepBuilderAPI_MakeEdge(new Geom_BSplineCurve(poles, weights, knots.values(), knots.counts(), curve.degree))
      .Shape();
}

TopoDS_Shape shape_of(const BSplineSurface& any) {
  const BSplineSurface surface = any.clamped();
  TColgp_Array2OfPnt poles(1, surface.rows(), 1, surface.columns());
  TColStd_Array2OfReal weights(1, surface.rows(), 1, surface.columns());
  for (int i = 0; i < surface.rows(); ++i)
    for (int j = 0; j < surface.columns(); ++j) {
      poles(i + 1, j + 1) = millimetres(surface.points.col(i * surface.columns() + j));
      weights(i + 1, j + 1) = surface.weights[i * surface.columns() + j];
    }
  const Multiple u(surface.knots[0]), v(surface.knots[1]);
  const Handle(Geom_BSplineSurface) made = new Geom_BSplineSurface(poles, weights, u.values(), v.values(), u.counts(),
                                                                   v.counts(), surface.degrees[0], surface.degrees[1]);
  return BRepBuilderAPI_MakeFace(made, Precision::Confusion()).Shape();
}

void add_shape(const TopoDS_Shape& shape, const std::string& name, CurveSet& to) {
  const std::size_t before = to.surfaces.size() + to.curves.size();
  const auto named = [&] {
    const std::size_t added = to.surfaces.size() + to.curves.size() - before;
    return added == 0 ? name : name + " " + std::to_string(added + 1);
  };
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
    to.surfaces.push_back({named(), surface_of(TopoDS::Face(face.Current()))});
  for (TopExp_Explorer edge(shape, TopAbs_EDGE, TopAbs_FACE); edge.More(); edge.Next())
    if (!BRep_Tool::Degenerated(TopoDS::Edge(edge.Current())))
      to.curves.push_back({named(), curve_of(TopoDS::Edge(edge.Current()))});
}

}  // namespace snug::mesh

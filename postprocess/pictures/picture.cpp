// SPDX-License-Identifier: Apache-2.0
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkImageShrink3D.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "postprocess/contact_statistics.h"
#include "postprocess/pictures.h"
#include "postprocess/pictures/machine.h"
#include "postprocess/surfaces/vtk_surface.h"

namespace postprocess {
namespace {

using dem_gpu::RunGeometry;
using dem_gpu::Snapshot;
using dem_gpu::Vec3;
using dem_gpu::WallGeometry;
using dem_gpu::WallKind;
using Colour = std::array<double, 3>;

// Drawn this many times larger and averaged down: smooth edges without relying on the driver's multisampling.
constexpr int kSupersampling = 2;
constexpr int kSphereLevels = 3;
// Below this angle between faces a surface is shaded as round [degrees].
constexpr double kFeatureAngle = 28;

constexpr Colour kShell{0.85, 0.885, 0.91}, kLifter{0.36, 0.42, 0.47}, kEdge{0.45, 0.50, 0.55},
    kFloor{0.90, 0.90, 0.88};
constexpr Colour kInk{0.15, 0.17, 0.19};
constexpr double kGlass = 0.13;  // opacity of the near half of a shell

/// From stone at rest over amber to dark red at full speed; lightness falls all the way.
vtkSmartPointer<vtkColorTransferFunction> speed_colours(double fastest) {
  auto colours = vtkSmartPointer<vtkColorTransferFunction>::New();
  constexpr std::array<std::array<double, 4>, 6> stops{{{0.00, 0.80, 0.775, 0.72},
                                                        {0.15, 0.88, 0.78, 0.56},
                                                        {0.35, 0.93, 0.67, 0.30},
                                                        {0.60, 0.87, 0.42, 0.17},
                                                        {0.82, 0.70, 0.18, 0.15},
                                                        {1.00, 0.44, 0.05, 0.14}}};
  for (const auto& [place, red, green, blue] : stops) colours->AddRGBPoint(place * fastest, red, green, blue);
  return colours;
}

/// `ambient`: share of the colour that shows whatever the light.
void set_colour(vtkProperty* property, const Colour& colour, double ambient) {
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetAmbient(ambient);
  property->SetDiffuse(1 - ambient);
}

/// Smoothly shaded where faces meet at a small angle.
vtkSmartPointer<vtkActor> shaded_actor(vtkPolyData* mesh) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SetFeatureAngle(kFeatureAngle);
  normals->SplittingOn();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// The active bodies of which is_sphere holds or not, coloured by speed.
void add_bodies(vtkRenderer* renderer, const RunGeometry& geometry, const Snapshot& snapshot, bool are_spheres,
                vtkColorTransferFunction* colours) {
  Surface surface;
  vtkNew<vtkFloatArray> speed;
  std::vector<Surface> shapes;
  for (const dem_gpu::ShapeGeometry& shape : geometry.shapes) shapes.push_back(shape_surface(shape, kSphereLevels));
  for (std::size_t b = 0; b < geometry.body_shape.size(); ++b) {
    const bool is_sphere = geometry.shapes[geometry.body_shape[b]].sphere_radius > 0;
    if (!snapshot.active[b] || is_sphere != are_spheres) continue;
    const auto [begin, end] =
        append(surface, shapes[geometry.body_shape[b]], body_placement(geometry, snapshot, static_cast<int>(b)));
    for (int p = begin; p < end; ++p) speed->InsertNextValue(static_cast<float>(norm(snapshot.velocity[b])));
  }
  if (surface.polygon_count() == 0) return;
  vtkNew<vtkPolyData> mesh;
  set_surface(mesh, surface);
  mesh->GetCellData()->SetScalars(speed);
  const auto actor = shaded_actor(mesh);
  actor->GetMapper()->ScalarVisibilityOn();
  actor->GetMapper()->SetScalarModeToUseCellData();
  actor->GetMapper()->SetLookupTable(colours);
  actor->GetMapper()->UseLookupTableScalarRangeOn();
  set_colour(actor->GetProperty(), {1, 1, 1}, 0.26);
  actor->GetProperty()->SetSpecular(are_spheres ? 0.55 : 0.06);
  actor->GetProperty()->SetSpecularPower(are_spheres ? 40 : 15);
  renderer->AddActor(actor);
}

void add_surface(vtkRenderer* renderer, const Surface& surface, const Colour& colour, double opacity) {
  if (surface.polygon_count() == 0) return;
  vtkNew<vtkPolyData> mesh;
  set_surface(mesh, surface);
  const auto actor = shaded_actor(mesh);
  set_colour(actor->GetProperty(), colour, 0.45);
  actor->GetProperty()->SetOpacity(opacity);
  renderer->AddActor(actor);
}

void add_outline(vtkRenderer* renderer, const std::vector<Vec3>& loop) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<vtkIdType>(loop.size()) + 1);
  for (const Vec3& p : loop) lines->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
  lines->InsertCellPoint(0);
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(kEdge[0], kEdge[1], kEdge[2]);
  actor->GetProperty()->SetLineWidth(1.3F * kSupersampling);
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
}

/// Polygons of `surface` whose inner side (to which `inward` points from a polygon's middle) shows to the eye, or not.
Surface half_of(const Surface& surface, const Vec3& eye, bool shows_inside, auto inward) {
  Surface half;
  half.points = surface.points;
  for (int p = 0; p < surface.polygon_count(); ++p) {
    const std::vector<int> corners(surface.corners.begin() + surface.polygon_begin(p),
                                   surface.corners.begin() + surface.polygon_end[p]);
    Vec3 middle;
    for (const int corner : corners) middle += surface.points[corner] / static_cast<double>(corners.size());
    if ((dot(inward(corners, middle), eye - middle) > 0) == shows_inside) half.add_polygon(corners);
  }
  return half;
}

/// Cylinder or cone: the half beyond solid, the half in front like glass, both rims drawn.
void add_shell(vtkRenderer* renderer, const WallGeometry& wall, const Placement& placement, const Vec3& eye) {
  Surface shell;
  append(shell, wall_surface(wall, {}, 180), placement);
  const dem_gpu::Mat3 rotation = rotation_matrix(placement.rotation);
  const Vec3 axis = rotation * wall.direction;
  const Vec3 base = rotation * wall.point + placement.translation;
  const auto inward = [&](const std::vector<int>& corners, const Vec3& middle) {
    const Vec3 along = shell.points[corners[3]] - shell.points[corners[0]];
    const Vec3 around = shell.points[corners[1]] - shell.points[corners[0]];
    const Vec3 normal = cross(around, along);
    const Vec3 to_axis = base + dot(middle - base, axis) * axis - middle;
    return dot(normal, to_axis) > 0 ? normal : -normal;
  };
  add_surface(renderer, half_of(shell, eye, true, inward), kShell, 1);
  add_surface(renderer, half_of(shell, eye, false, inward), kShell, kGlass);
  const auto ring = shell.points.begin() + static_cast<std::ptrdiff_t>(shell.points.size() / 2);
  add_outline(renderer, {shell.points.begin(), ring});
  add_outline(renderer, {ring, shell.points.end()});
}

/// Mesh or sphere: what turns its front to the eye solid, the rest like glass, so that a container shows what it holds.
void add_closed(vtkRenderer* renderer, const Surface& surface, const Vec3& eye, const auto& outward) {
  add_surface(renderer, half_of(surface, eye, true, outward), kShell, 1);
  add_surface(renderer, half_of(surface, eye, false, outward), kShell, kGlass);
}

/// Disc or plane: solid where its front shows, else only its rim.
void add_plate(vtkRenderer* renderer, const Surface& plate, const Vec3& normal, const Vec3& eye, const Colour& colour) {
  if (plate.points.empty() || plate.polygon_count() == 0) return;
  if (dot(normal, eye - plate.points[0]) > 0) add_surface(renderer, plate, colour, 1);
  add_outline(renderer, plate.points);
}

void add_walls(vtkRenderer* renderer, const RunGeometry& geometry, const Snapshot& snapshot, const PictureView& view) {
  const Machine machine = machine_of(geometry.walls, view.up);
  const Bounds bounds = scene_bounds(geometry, snapshot);
  for (std::size_t w = 0; w < geometry.walls.size(); ++w) {
    if (!snapshot.wall_present[w]) continue;
    const WallGeometry wall = as_drawn(geometry.walls[w], machine);
    const Placement placement = wall_placement(snapshot, static_cast<int>(w));
    const Vec3 direction = rotate(placement.rotation, wall.direction);
    Surface surface;
    switch (wall.kind) {
      case WallKind::cylinder:
      case WallKind::cone:
        add_shell(renderer, wall, placement, view.eye);
        break;
      case WallKind::disc:
        append(surface, wall_surface(wall, {}, 180), placement);
        add_plate(renderer, surface, direction, view.eye, kShell);
        break;
      case WallKind::plane:
        append(surface, wall_surface(wall, bounds), placement);
        add_plate(renderer, surface, direction, view.eye, kFloor);
        break;
      case WallKind::volume_object:
        append(surface, wall_surface(wall, {}), placement);
        add_surface(renderer, surface, kLifter, 1);
        break;
      case WallKind::mesh:
        append(surface, wall_surface(wall, {}), placement);
        add_closed(renderer, surface, view.eye, [&](const std::vector<int>& corners, const Vec3&) {
          const Vec3 first = surface.points[corners[0]];
          return cross(surface.points[corners[1]] - first, surface.points[corners[2]] - first);
        });
        break;
      case WallKind::sphere: {
        append(surface, wall_surface(wall, {}), placement);
        const Vec3 centre = rotate(placement.rotation, wall.point) + placement.translation;
        add_closed(renderer, surface, view.eye,
                   [&](const std::vector<int>&, const Vec3& middle) { return centre - middle; });
        break;
      }
    }
  }
}

void add_colour_scale(vtkRenderer* renderer, vtkColorTransferFunction* colours, const PictureSize& size) {
  vtkNew<vtkScalarBarActor> scale;
  scale->SetLookupTable(colours);
  scale->SetTitle("speed [m/s]\n ");
  scale->SetNumberOfLabels(5);
  scale->SetLabelFormat("%.3g");
  scale->UnconstrainedFontSizeOn();
  scale->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  scale->SetPosition(0.885, 0.22);
  scale->SetWidth(0.10);
  scale->SetHeight(0.56);
  scale->SetBarRatio(0.22);
  scale->SetMaximumWidthInPixels(size.width * kSupersampling);
  scale->SetMaximumHeightInPixels(size.height * kSupersampling);
  for (vtkTextProperty* text : {scale->GetTitleTextProperty(), scale->GetLabelTextProperty()}) {
    text->SetColor(kInk[0], kInk[1], kInk[2]);
    text->SetFontSize(size.height / 45 * kSupersampling);
    text->SetFontFamilyToArial();
    text->BoldOff();
    text->ItalicOff();
    text->ShadowOff();
  }
  renderer->AddActor2D(scale);
}

void add_time_label(vtkRenderer* renderer, double time, const PictureSize& size) {
  char label[40];
  std::snprintf(label, sizeof label, "t = %.2f s", time);
  vtkNew<vtkTextActor> text;
  text->SetInput(label);
  text->GetTextProperty()->SetFontSize(size.height / 38 * kSupersampling);
  text->GetTextProperty()->SetColor(kInk[0], kInk[1], kInk[2]);
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(0.025, 0.025);
  renderer->AddActor2D(text);
}

void add_lights(vtkRenderer* renderer, const PictureView& view) {
  const Vec3 backward = dem_gpu::unit_or(view.eye - view.focus, {0, 0, 1});
  const Vec3 right = cross(view.up, backward);
  const double distance = norm(view.eye - view.focus);
  const auto add_light = [&](double across, double above, double intensity) {
    const Vec3 from = view.eye + distance * (across * right + above * view.up);
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPositional(false);
    light->SetPosition(from.x, from.y, from.z);
    light->SetFocalPoint(view.focus.x, view.focus.y, view.focus.z);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  };
  renderer->AutomaticLightCreationOff();
  add_light(-0.7, 1.1, 0.95);  // key light from the upper left
  add_light(1.2, 0.1, 0.34);   // fill
  add_light(0, 0, 0.34);       // from the eye
}

void set_camera(vtkRenderer* renderer, const PictureView& view) {
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(view.eye.x, view.eye.y, view.eye.z);
  camera->SetFocalPoint(view.focus.x, view.focus.y, view.focus.z);
  camera->SetViewUp(view.up.x, view.up.y, view.up.z);
  camera->SetViewAngle(view.view_angle);
  camera->SetWindowCenter(0.11, 0);  // room for the colour scale on the right
  renderer->ResetCameraClippingRange();
}

/// Soft shadows where surfaces are close, within about a body's size.
void add_ambient_occlusion(vtkRenderer* renderer, const RunGeometry& geometry) {
  double size = 0;
  for (std::size_t b = 0; b < geometry.body_shape.size(); ++b)
    size += equivalent_diameter(geometry, static_cast<int>(b)) / static_cast<double>(geometry.body_shape.size());
  if (size <= 0) return;
  renderer->UseSSAOOn();
  renderer->SetSSAORadius(1.1 * size);
  renderer->SetSSAOBias(0.12 * size);
  renderer->SetSSAOKernelSize(64);
  renderer->SSAOBlurOn();
}

}  // namespace

std::string picture_png(const RunGeometry& geometry, const Snapshot& snapshot, const PictureView& view,
                        const PictureSize& size) {
  check_same_run(geometry, snapshot);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.965, 0.97, 0.975);
  renderer->SetBackground2(1, 1, 1);
  renderer->GradientBackgroundOn();
  const auto colours = speed_colours(view.fastest);
  add_bodies(renderer, geometry, snapshot, false, colours);
  add_bodies(renderer, geometry, snapshot, true, colours);
  add_walls(renderer, geometry, snapshot, view);
  add_colour_scale(renderer, colours, size);
  add_time_label(renderer, snapshot.time, size);
  add_lights(renderer, view);
  add_ambient_occlusion(renderer, geometry);
  set_camera(renderer, view);

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(size.width * kSupersampling, size.height * kSupersampling);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(image->GetOutputPort());
  average->SetShrinkFactors(kSupersampling, kSupersampling, 1);
  average->MeanOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(average->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (bytes == nullptr || bytes->GetNumberOfTuples() == 0) throw std::runtime_error("the picture could not be drawn");
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfTuples())};
}

}  // namespace postprocess

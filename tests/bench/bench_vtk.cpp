// Times VTK's volume mappers on the same scenes: the fixed-point ray caster on the CPU (2 threads, or
// --threads) and the GPU ray caster on the available OpenGL (llvmpipe without a GPU). Needs a display:
// xvfb-run bench_vtk PATH SCENE.json...
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/bench/peer.h"
#include "viewer/volume/parallel.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2)

namespace {

using namespace volumen;

vtkSmartPointer<vtkImageData> imageOf(const Volume& volume) {
  const auto image = vtkSmartPointer<vtkImageData>::New();
  const glm::ivec3 n = volume.size();
  const glm::dvec3 spacing = volume.geometry().spacing();
  image->SetDimensions(n.x, n.y, n.z);
  image->SetSpacing(spacing.x, spacing.y, spacing.z);
  image->AllocateScalars(VTK_SHORT, 1);
  auto* to = static_cast<short*>(image->GetScalarPointer());
  for (std::int64_t v = 0; v < volume.geometry().voxelCount(); ++v) to[v] = short(volume.valueAt(v));
  return image;
}

// Returns the transform from the image's own axes, in mm, to patient space.
vtkSmartPointer<vtkMatrix4x4> patientFromImage(const VoxelGeometry& g) {
  const auto m = vtkSmartPointer<vtkMatrix4x4>::New();
  const glm::dvec3 spacing = g.spacing();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m->SetElement(r, c, g.patientFromVoxelStep[c][r] / spacing[c]);
    m->SetElement(r, 3, g.origin[r]);
  }
  return m;
}

vtkSmartPointer<vtkVolumeProperty> propertyOf(const Scene& scene) {
  vtkNew<vtkColorTransferFunction> colour;
  vtkNew<vtkPiecewiseFunction> opacity;
  for (const CurvePoint& p : scene.transferFunction.points) {
    colour->AddRGBPoint(p.value, p.colour.r, p.colour.g, p.colour.b);
    opacity->AddPoint(p.value, p.opacity);
  }
  const auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(colour);
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(scene.transferFunction.unitDistance);
  property->SetInterpolationTypeToLinear();
  property->SetShade(scene.shading.lit);
  property->SetAmbient(scene.shading.ambient);
  property->SetDiffuse(scene.shading.diffuse);
  property->SetSpecular(scene.shading.specular);
  property->SetSpecularPower(scene.shading.shininess);
  return property;
}

class VtkPeer : public bench::Peer {
 public:
  VtkPeer(std::string name, double stopsAt, vtkSmartPointer<vtkVolumeMapper> mapper, const Volume& volume,
          const Scene& scene)
      : name_(std::move(name)), stopsAt_(stopsAt) {
    mapper->SetInputDataObject(imageOf(volume));
    volume_->SetMapper(mapper);
    volume_->SetProperty(propertyOf(scene));
    volume_->SetUserMatrix(patientFromImage(volume.geometry()));
    renderer_->AddVolume(volume_);
    renderer_->AutomaticLightCreationOff();
    for (const Light& l : scene.lights) {
      if (!l.on || l.space != Space::camera) continue;
      vtkNew<vtkLight> light;
      light->SetLightTypeToCameraLight();
      light->SetFocalPoint(0, 0, 0);
      light->SetPosition(l.direction.x, l.direction.y, l.direction.z);
      light->SetColor(l.colour.r, l.colour.g, l.colour.b);
      light->SetIntensity(l.intensity);
      renderer_->AddLight(light);
    }
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(512, 512);
    window_->AddRenderer(renderer_);
  }

  std::string name() const override { return name_; }
  double stopsAt() const override { return stopsAt_; }

  void draw(const Camera& camera) override {
    vtkCamera* c = renderer_->GetActiveCamera();
    const CameraAxes axes = cameraAxes(camera);
    const glm::dvec3 target = *camera.target, eye = target - 1000.0 * axes.direction;
    c->ParallelProjectionOn();
    c->SetFocalPoint(target.x, target.y, target.z);
    c->SetPosition(eye.x, eye.y, eye.z);
    c->SetViewUp(axes.up.x, axes.up.y, axes.up.z);
    c->SetParallelScale(camera.height / 2);
    renderer_->ResetCameraClippingRange();
    window_->Render();
  }

  std::vector<std::uint8_t> rgb() const override {
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->GetPixelData(0, 0, 511, 511, 1, pixels);
    std::vector<std::uint8_t> out;
    for (int y = 511; y >= 0; --y)  // the first row is at the bottom
      for (int x = 0; x < 3 * 512; ++x) out.push_back(pixels->GetValue(y * 3 * 512 + x));
    return out;
  }

 private:
  std::string name_;
  double stopsAt_;
  vtkNew<vtkVolume> volume_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

std::vector<std::unique_ptr<bench::Peer>> makePeers(const Volume& volume, const Scene& scene) {
  const double step = scene.transferFunction.unitDistance;
  const auto cpu = vtkSmartPointer<vtkFixedPointVolumeRayCastMapper>::New();
  cpu->SetNumberOfThreads(allowedThreads());
  cpu->AutoAdjustSampleDistancesOff();
  cpu->SetSampleDistance(float(step));
  cpu->SetInteractiveSampleDistance(float(step));
  cpu->SetImageSampleDistance(1);
  const auto gpu = vtkSmartPointer<vtkGPUVolumeRayCastMapper>::New();
  gpu->AutoAdjustSampleDistancesOff();
  gpu->SetSampleDistance(float(step));
  gpu->SetImageSampleDistance(1);
  std::vector<std::unique_ptr<bench::Peer>> peers;
  // vtkFixedPointVolumeRayCastHelper.h ends rays below 0xff of 0x7fff, raycasterfs.glsl above 1 - 1/255.
  peers.push_back(std::make_unique<VtkPeer>("VTK fixed-point mapper", 255.0 / 32767, cpu, volume, scene));
  peers.push_back(std::make_unique<VtkPeer>("VTK GPU mapper", 1.0 / 255, gpu, volume, scene));
  return peers;
}

}  // namespace

int main(int argc, char** argv) { return volumen::bench::comparePeers(argc, argv, makePeers); }

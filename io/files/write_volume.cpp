#include "io/files/write_volume.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "io/files/header_text.h"
#include "io/files/nrrd_write.h"
#include "io/files/output_file.h"
#include "io/files/sample_type.h"
#include "io/files/volume_writers.h"

static_assert(std::endian::native == std::endian::little, "samples are written in this machine's order");

namespace volumen {

namespace {

// Stored form of samples: `type` of slope * stored + intercept.
struct Form {
  SampleType type = SampleType::float32;
  double slope = 1, intercept = 0;
};

SampleType storedType(const Volume& volume) {
  static constexpr SampleType types[] = {SampleType::uint8, SampleType::int16, SampleType::uint16,
                                         SampleType::float32};
  return types[volume.stored().index()];
}

// Returns the form for formats without rescale: real values, as integers if they are whole.
Form realForm(const Volume& volume) {
  const Form real{SampleType::float32, volume.slope(), volume.intercept()};
  if (volume.slope() != 1 || volume.intercept() != std::floor(volume.intercept())) return real;
  if (volume.intercept() == 0) return {storedType(volume)};
  return std::visit(
      [&](const auto& values) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const double least = double(*low) + volume.intercept(), most = double(*high) + volume.intercept();
        constexpr double exactInFloat = 1 << 24;
        Form form = real;
        if (least >= 0 && most <= 65535)
          form.type = SampleType::uint16;
        else if (least >= -32768 && most <= 32767)
          form.type = SampleType::int16;
        else if (least >= -exactInFloat && most <= exactInFloat)
          form.type = SampleType::int32;
        return form;
      },
      volume.stored());
}

// Returns the form for NIfTI, whose slope and intercept are float32.
Form niftiForm(const Volume& volume) {
  const double slope = volume.slope(), intercept = volume.intercept();
  if (double(float(slope)) == slope && double(float(intercept)) == intercept) return {storedType(volume)};
  return {SampleType::float32, slope, intercept};
}

Status writeSamples(const Volume& volume, const Form& form, OutputFile& out, const Progress& progress,
                    const CancelToken& cancel) {
  return withSampleType(form.type, [&](auto type) -> Status {
    using To = decltype(type);
    return std::visit(
        [&](const auto& values) -> Status {
          constexpr std::size_t chunk = 1 << 18;
          std::vector<To> part;
          for (std::size_t done = 0; done < values.size(); done += part.size()) {
            if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
            if (progress) progress("writing voxels", done, values.size());
            part.resize(std::min(chunk, values.size() - done));
            for (std::size_t n = 0; n < part.size(); ++n)
              part[n] = To(form.slope * double(values[done + n]) + form.intercept);
            if (Status s = out.write(part.data(), part.size() * sizeof(To)); !s) return s;
          }
          return {};
        },
        volume.stored());
  });
}

std::string rowText(glm::dvec3 v, const char* between) {
  return exactText(v.x) + between + exactText(v.y) + between + exactText(v.z);
}

const char* metaTypeName(SampleType type) {
  static constexpr const char* names[] = {"MET_CHAR",  "MET_UCHAR", "MET_SHORT",     "MET_USHORT",
                                          "MET_INT",   "MET_UINT",  "MET_LONG_LONG", "MET_ULONG_LONG",
                                          "MET_FLOAT", "MET_DOUBLE"};
  return names[int(type)];
}

std::string metaHeader(const VoxelGeometry& g, SampleType type) {
  std::string text =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
      "CompressedData = False\n";
  if (g.calibrated) {
    const glm::dvec3 s = g.spacing();
    const glm::dmat3& L = g.patientFromVoxelStep;
    text += "TransformMatrix = " + rowText(L[0] / s.x, " ") + ' ' + rowText(L[1] / s.y, " ") + ' ' +
            rowText(L[2] / s.z, " ") + "\nOffset = " + rowText(g.origin, " ") +
            "\nCenterOfRotation = 0 0 0\nElementSpacing = " + rowText(s, " ") + '\n';
  }
  text += "DimSize = " + std::to_string(g.size.x) + ' ' + std::to_string(g.size.y) + ' ' +
          std::to_string(g.size.z) + "\nElementType = ";
  text += metaTypeName(type);
  return text + "\nElementDataFile = LOCAL\n";
}

// Opens a NIfTI file and writes everything before the samples.
Result<OutputFile> startNifti(const Volume& volume, const Form& form, const NiftiTime& time,
                              const std::string& path) {
  const bool scaled = form.slope == 1 && form.intercept == 0;
  auto header = niftiHeader(volume.geometry(), form.type, scaled ? volume.slope() : 1,
                            scaled ? volume.intercept() : 0, time);
  if (!header) return Error{path + ": " + header.message()};
  auto out = OutputFile::create(path);
  if (!out) return out;
  if (Status s = out->startGzip(); !s) return s.error();
  if (Status s = out->write(*header); !s) return s.error();
  return out;
}

// Returns null if no writer has the path's ending.
const VolumeWriter* writerOf(const std::string& path) {
  const std::string name = lowerCase(path);
  for (const VolumeWriter& writer : volumeWriters())
    if (name.ends_with(writer.ending)) return &writer;
  return nullptr;
}

bool sameGrid(const VoxelGeometry& a, const VoxelGeometry& b) {
  constexpr double ofAVoxel = 1e-3;
  const double mm = ofAVoxel * std::min({a.spacing().x, a.spacing().y, a.spacing().z});
  if (a.size != b.size || a.calibrated != b.calibrated) return false;
  const std::vector<glm::dvec3> p = a.boxCorners(), q = b.boxCorners();
  for (std::size_t n = 0; n < p.size(); ++n)
    if (glm::length(p[n] - q[n]) > mm) return false;
  return true;
}

std::string gridText(const VoxelGeometry& g) {
  return std::to_string(g.size.x) + " x " + std::to_string(g.size.y) + " x " + std::to_string(g.size.z);
}

// A form for all volumes: stored integers if all share the first volume's rescale.
struct CommonForm {
  SampleType type = SampleType::float32;
  double slope = 1, intercept = 0;
  bool operator==(const CommonForm&) const = default;
};

CommonForm commonForm(const Volume& volume) {
  return {storedType(volume), volume.slope(), volume.intercept()};
}

// Writes the volumes in sequence; returns false if one has another form than the first, unless `asReals`.
Result<bool> writeVolumes(const NiftiTime& time, const VolumeAt& volumeAt, bool asReals,
                          const std::string& path, const Progress& progress, const CancelToken& cancel) {
  std::optional<OutputFile> out;
  std::optional<VoxelGeometry> grid;
  CommonForm first;
  for (int n = 0; n < time.volumes; ++n) {
    if (progress) progress("writing volumes", std::size_t(n), std::size_t(time.volumes));
    const Result<VolumePtr> volume = volumeAt(n);
    if (!volume) return volume.error();
    const VoxelGeometry& g = (*volume)->geometry();
    if (!out) grid = g, first = commonForm(**volume);
    if (!sameGrid(*grid, g))
      return Error{"Volume " + std::to_string(n + 1) + " (" + gridText(g) +
                   ") does not lie on the grid of the first (" + gridText(*grid) +
                   "): NIfTI holds volumes of one grid; write them one by one with --series."};
    if (!asReals && commonForm(**volume) != first) return false;
    const Form form =
        asReals ? Form{SampleType::float32, (*volume)->slope(), (*volume)->intercept()} : niftiForm(**volume);
    if (!out) {
      auto started = startNifti(**volume, form, time, path);
      if (!started) return started.error();
      out.emplace(std::move(*started));
    }
    if (Status s = writeSamples(**volume, form, *out, {}, cancel); !s) return s.error();
  }
  if (Status s = out->commit(); !s) return s.error();
  return true;
}

}  // namespace

Status writeNrrd(const Volume& volume, const std::string& path, const NrrdKeyValues& keyValues,
                 const Progress& progress, const CancelToken& cancel) {
  const Form form = realForm(volume);
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  if (Status s = out->write(nrrdHeader(volume.geometry(), form.type, keyValues)); !s) return s;
  if (Status s = out->startGzip(); !s) return s;
  if (Status s = writeSamples(volume, form, *out, progress, cancel); !s) return s;
  return out->commit();
}

Status writePlainNrrd(const Volume& volume, const std::string& path, const Progress& progress,
                      const CancelToken& cancel) {
  return writeNrrd(volume, path, {}, progress, cancel);
}

Status writeNifti(const Volume& volume, const std::string& path, const Progress& progress,
                  const CancelToken& cancel) {
  const Form form = niftiForm(volume);
  auto out = startNifti(volume, form, {}, path);
  if (!out) return out.error();
  if (Status s = writeSamples(volume, form, *out, progress, cancel); !s) return s;
  return out->commit();
}

Status writeMetaImage(const Volume& volume, const std::string& path, const Progress& progress,
                      const CancelToken& cancel) {
  const Form form = realForm(volume);
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  if (Status s = out->write(metaHeader(volume.geometry(), form.type)); !s) return s;
  if (Status s = writeSamples(volume, form, *out, progress, cancel); !s) return s;
  return out->commit();
}

Status writeNiftiVolumes(const NiftiTime& time, const VolumeAt& volumeAt, const std::string& path,
                         const Progress& progress, const CancelToken& cancel) {
  Result<bool> written = writeVolumes(time, volumeAt, false, path, progress, cancel);
  if (written && !*written) written = writeVolumes(time, volumeAt, true, path, progress, cancel);
  return written ? Status() : Status(written.error());
}

bool isVolumeFileName(const std::string& path) { return writerOf(path) != nullptr; }

Status writeVolume(const Volume& volume, const std::string& path, const Progress& progress,
                   const CancelToken& cancel) {
  if (const VolumeWriter* writer = writerOf(path)) return writer->write(volume, path, progress, cancel);
  return Error{path + ": volumes are written as " + volumeEndings() + "."};
}

}  // namespace volumen

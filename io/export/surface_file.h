#pragma once

#include <span>
#include <string>

#include "io/export/identity_fields.h"
#include "io/files/output_file.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns ".stl, .ply or .obj".
std::string surfaceEndings();

/// Writes a surface in the format of the path's ending: .stl (binary), .ply (binary, little endian) or .obj
/// (text). Coordinates are patient space in mm, LPS; the header says "SPACE=LPS", which 3D Slicer reads.
/// Points are float32; the normals in .stl are those of the triangles. The file appears whole or not at all.
/// The Error names it: an unknown ending, a surface without triangles, or cancelled.
Status writeSurface(const Surface& surface, const std::string& path, const CancelToken& cancel = {});

/// One of several surfaces in a file.
struct SurfacePart {
  std::string name;
  const Surface* surface = nullptr;  ///< must have triangles
};

/// Writes several surfaces one after the other. Each keeps its own points, so closed surfaces stay closed. In
/// .obj each is a group ("g NAME", blanks become "_", names are unique); .stl and .ply do not separate them.
/// Also an Error: no surfaces, or too many triangles for one file.
Status writeSurfaces(std::span<const SurfacePart> parts, const std::string& path,
                     const CancelToken& cancel = {});

/// Writes several surfaces to a temporary file, which appears once it is committed. Comments of .ply and .obj
/// hold the fields of `whose`; the header of .stl holds as many of their values as fit.
Result<OutputFile> surfacesAside(std::span<const SurfacePart> parts, const std::string& path,
                                 const CancelToken& cancel = {}, const IdentityFields& whose = {});

}  // namespace volumen

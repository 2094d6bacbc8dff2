#pragma once

#include <span>
#include <string>

#include "io/files/output_file.h"
#include "viewer/segment/surface.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// ".stl, .ply or .obj".
std::string surfaceEndings();

/// Writes a surface in the format that the path's ending asks for: .stl (binary), .ply (binary, little
/// endian) or .obj (text). Patient space, mm, LPS, which its header says in the words that 3D Slicer reads:
/// "SPACE=LPS". Points as float32; the normals of .stl are those of its triangles. The file appears whole or
/// not at all; an Error names it: another ending, a surface without triangles, cancelled.
Status writeSurface(const Surface& surface, const std::string& path, const CancelToken& cancel = {});

/// One of several surfaces of a file.
struct SurfacePart {
  std::string name;
  const Surface* surface = nullptr;  ///< has triangles
};

/// The same of several, one after the other, each with points of its own: closed by itself where it was. In
/// .obj each is a group ("g NAME", blanks of the name as "_", no two called alike), in .stl and .ply nothing
/// parts them. An Error also where there are none, or too many triangles for one file.
Status writeSurfaces(std::span<const SurfacePart> parts, const std::string& path,
                     const CancelToken& cancel = {});

/// The same, written aside: it appears once it is committed.
Result<OutputFile> surfacesAside(std::span<const SurfacePart> parts, const std::string& path,
                                 const CancelToken& cancel = {});

}  // namespace volumen

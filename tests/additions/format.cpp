// An addition that reads a format: a line "cube N" followed by N x N x N bytes.
#include "io/files/binary_header.h"
#include "io/files/formats.h"

namespace volumen {

bool isCube(const FileClaim& file) { return file.head.starts_with("cube "); }

Result<ImageHeader> readCubeHeader(const std::string& path) {
  const auto header = readBinaryHeader(path, 7);
  if (!header) return header.error();
  ImageHeader image;
  image.format = "Cube";
  const int edge = header->head[5] - '0';
  const auto grid = setSizes(image, {edge, edge, edge}, path);
  if (!grid) return grid.error();
  if (Status s = setUnorientedGrid(image, *grid, {1, 1, 1}, {}, path); !s) return s.error();
  setDataAt(image.data, path, 7, header->compressed);
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen

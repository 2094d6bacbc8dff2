#include <string_view>

#include "io/files/other_formats.h"

namespace volumen {

std::string unreadFormat(const FileClaim& file) {
  using namespace std::string_view_literals;
  struct Known {
    std::string_view begins, nameEnds;  // either may be empty
    const char* name;
  };
  constexpr Known formats[] = {
      {"\x89HDF\r\n\x1a\n"sv, ".mnc", "MINC 2"},
      {"\x89HDF\r\n\x1a\n"sv, "", "HDF5"},
      {"CDF\x01"sv, "", "MINC or netCDF"},
      {"CDF\x02"sv, "", "MINC or netCDF"},
      {"II*\0"sv, "", "TIFF"},
      {"MM\0*"sv, "", "TIFF"},
      {"II+\0"sv, "", "TIFF"},
      {"", "/2dseq", "Bruker ParaVision"},
      {"# === DATA DESCRIPTION FILE"sv, "", "Philips PAR/REC"},
      {"", ".rec", "Philips PAR/REC"},
      {"CTDATA-HEADER_V1"sv, "", "Scanco ISQ"},
      {"#!/usr/local/fdf/startup"sv, "", "Varian FDF"},
      {"MATRIX7"sv, "", "ECAT"},
      {"IMGF"sv, "", "GE Signa"},
      {"", "+orig.head", "AFNI"},
      {"", "+tlrc.head", "AFNI"},
      {"<?xml"sv, ".vti", "VTK XML"},
      {"<VTKFile"sv, "", "VTK XML"},
  };
  for (const Known& format : formats)
    if (file.head.starts_with(format.begins) && file.name.ends_with(format.nameEnds)) return format.name;
  return {};
}

}  // namespace volumen

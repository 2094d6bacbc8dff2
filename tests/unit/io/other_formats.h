#pragma once

#include <QByteArray>
#include <algorithm>
#include <cstdint>
#include <functional>

namespace volumen::tests {

// Files of 4 x 3 x 2 voxels of 1 x 2 x 3 mm with values 1 to 24, built byte by byte. Formats are other than
// DICOM, NRRD, NIfTI and MetaImage.

template <class T>
void put(QByteArray& header, int place, T value, bool bigEndian = true) {
  QByteArray bytes(reinterpret_cast<const char*>(&value), sizeof value);
  if (bigEndian) std::reverse(bytes.begin(), bytes.end());
  header.replace(place, sizeof value, bytes);
}

// Returns 4 x 3 x 2 samples of 16 bits, from 1 on.
inline QByteArray samples(bool bigEndian = true, int count = 24) {
  QByteArray data(2 * count, '\0');
  for (int n = 0; n < count; ++n) put(data, 2 * n, std::int16_t(n + 1), bigEndian);
  return data;
}

using Change = std::function<void(QByteArray&)>;

inline QByteArray changed(QByteArray header, const Change& change) {
  if (change) change(header);
  return header;
}

inline QByteArray analyzeHeader(const Change& change = {}) {
  QByteArray h(348, '\0');
  put<std::int32_t>(h, 0, 348);
  const std::int16_t dims[] = {3, 4, 3, 2};
  for (int n = 0; n < 4; ++n) put(h, 40 + 2 * n, dims[n]);
  put<std::int16_t>(h, 70, 4);
  put<std::int16_t>(h, 72, 16);
  for (int n = 0; n < 3; ++n) put(h, 80 + 4 * n, float(n + 1));
  return changed(h, change);
}

inline QByteArray mgh(const Change& change = {}) {
  QByteArray h(284, '\0');
  const std::int32_t numbers[] = {1, 4, 3, 2, 1, 4};
  for (int n = 0; n < 6; ++n) put(h, 4 * n, numbers[n]);
  put<std::int16_t>(h, 28, 1);
  for (int n = 0; n < 3; ++n) put(h, 30 + 4 * n, float(n + 1));
  // Columns run to the left, rows down, slices to the front: RAS (-1, 0, 0), (0, 0, -1), (0, 1, 0).
  put(h, 42, -1.f), put(h, 62, -1.f), put(h, 70, 1.f);
  put(h, 78, 10.f), put(h, 82, 20.f), put(h, 86, 30.f);
  return changed(h, change) + samples();
}

inline QByteArray gipl(const Change& change = {}) {
  QByteArray h(256, '\0');
  const std::uint16_t dims[] = {4, 3, 2, 1, 15};
  for (int n = 0; n < 5; ++n) put(h, 2 * n, dims[n]);
  for (int n = 0; n < 3; ++n) put(h, 10 + 4 * n, float(n + 1)), put(h, 204 + 8 * n, double(10 * n));
  put(h, 252, 719555000u);
  return changed(h, change) + samples();
}

inline QByteArray mrc(bool bigEndian = false, const Change& change = {}) {
  QByteArray h(1024, '\0');
  const auto number = [&](int place, std::int32_t value) { put(h, place, value, bigEndian); };
  const std::int32_t sizes[] = {4, 3, 2};
  for (int n = 0; n < 3; ++n) {
    number(4 * n, sizes[n]);
    number(28 + 4 * n, sizes[n]);
    put(h, 40 + 4 * n, float(sizes[n]) * float(n + 1) * 1e7f, bigEndian);
    number(64 + 4 * n, n + 1);
  }
  number(12, 1);
  h.replace(208, 4, "MAP ");
  h.replace(212, 2, bigEndian ? QByteArray(2, '\x11') : QByteArray(2, '\x44'));
  return changed(h, change) + samples(bigEndian);
}

inline QByteArray vtk(const QByteArray& replace = {}, const QByteArray& by = {}) {
  QByteArray h =
      "# vtk DataFile Version 3.0\na title\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 3 2\nSPACING 1 2 "
      "3\n"
      "ORIGIN 0 10 20\nPOINT_DATA 24\nSCALARS s short 1\nLOOKUP_TABLE default\n";
  if (!replace.isEmpty()) h.replace(replace, by);
  return h + samples();
}

/// Returns the same file as text.
inline QByteArray vtkText() {
  QByteArray text = vtk("BINARY", "ASCII");
  text.truncate(text.indexOf("default\n") + 8);
  for (int n = 1; n <= 24; ++n) text += QByteArray::number(n) + (n % 9 == 0 ? '\n' : ' ');
  return text;
}

}  // namespace volumen::tests

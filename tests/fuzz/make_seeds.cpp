// Writes the seeds of the fuzz drivers. usage: make_seeds FOLDER.
#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <filesystem>

#include "io/dicom/inspect_files.h"
#include "io/files/write_volume.h"
#include "io/worker/dicom_fields.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/io/gzipped.h"
#include "tests/unit/io/other_formats.h"
#include "tests/unit/render/random_scenes.h"
#include "tests/unit/workspace/random_workspace.h"
#include "ui/workspace/session_json.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

void writeText(const std::string& path, const std::string& text) {
  writeAll(path, std::vector<std::uint8_t>(text.begin(), text.end()));
}

void dicomFiles(const std::string& folder) {
  DicomPicture picture;
  picture.columns = picture.rows = 24;
  for (int n = 0; n < picture.columns * picture.rows; ++n)
    picture.pixels.push_back(std::uint16_t(1000 + n * 7919 % 640));
  for (const char* syntax :
       {"1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2", "1.2.840.10008.1.2.1.99",
        "1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80"})
    writeDicom(folder + "/" + syntax, picture, syntax);
  for (const char* sopClass :
       {presentationClass, keyObjectClass, reportClass, structureSetClass, segmentationClass})
    writeObject(folder + "/" + sopClass, sopClass, [](DcmItem& item) {
      put(item, 0x0008, 0x0060, "OT");
      put(item, 0x0020, 0x000d, "1.2.3");
    });
}

// Writes the coded frame of a picture of 24 x 24 pixels, followed by the settings that fuzz_codec.cpp reads
// from the end: index of the transfer syntax, MONOCHROME2, columns and rows less 1 of two bytes each, 16 bits
// allocated, stored less 1.
void codedFrame(const std::vector<std::uint8_t>& file, std::uint8_t syntax, const std::string& path) {
  constexpr std::array<std::uint8_t, 4> item{0xfe, 0xff, 0x00, 0xe0};
  const auto table = std::search(file.begin(), file.end(), item.begin(), item.end());
  if (file.end() - table < 16) return;
  std::vector<std::uint8_t> bytes(table + 16, file.end());
  for (const std::uint8_t setting : {0, 0, 15, 1, 23, 0, 23, 0, 1}) bytes.push_back(setting);
  bytes.push_back(syntax);
  writeAll(path, bytes);
}

void codedFrames(const std::string& from, const std::string& folder) {
  const std::array<std::pair<const char*, int>, 3> syntaxes{
      {{"1.2.840.10008.1.2.5", 2}, {"1.2.840.10008.1.2.4.70", 6}, {"1.2.840.10008.1.2.4.80", 7}}};
  for (const auto& [syntax, place] : syntaxes)
    codedFrame(readAll(from + "/" + syntax), std::uint8_t(place), folder + "/" + syntax);
}

// Writes worker answers about three slices of a stack and about three pictures with other transfer syntaxes.
void answers(const std::string& from, const std::string& folder) {
  const auto write = [&](const std::string& name, const std::array<std::string, 3>& files) {
    worker::MemoryWriter writer;
    int n = 0;
    for (const std::string& file : files) {
      dicom::Inspection inspection = dicom::inspect(file);
      inspection.header.path = "/no/" + std::to_string(++n);
      writer.write(inspection);
    }
    writeAll(folder + "/" + name, std::move(writer).take());
  };
  std::array<std::string, 3> stack;
  for (int n = 0; n < 3; ++n) {
    stack[std::size_t(n)] = folder + "/slice" + std::to_string(n);
    DicomPicture picture;
    picture.instance = n + 1;
    picture.position = {0, 0, 2.5 * n};
    picture.pixels = {std::uint16_t(n)};
    writeDicom(stack[std::size_t(n)], picture);
  }
  write("stack", stack);
  for (const std::string& slice : stack) std::filesystem::remove(slice);
  write("syntaxes",
        {from + "/1.2.840.10008.1.2.5", from + "/1.2.840.10008.1.2.4.70", from + "/1.2.840.10008.1.2.4.80"});
}

// Writes an image file of each format. The first byte is the index of the extension in fuzz_image_file.cpp.
void imageFiles(const std::string& folder) {
  const Result<VolumePtr> volume = makePhantom("cube:8");
  if (!volume) return;
  const std::array<std::pair<const char*, char>, 3> endings{{{".nrrd", 0}, {".nii.gz", 3}, {".mha", 4}}};
  for (const auto& [ending, number] : endings) {
    const std::string path = folder + "/seed" + ending;
    if (!writeVolume(**volume, path)) continue;
    std::vector<std::uint8_t> bytes = readAll(path);
    bytes.insert(bytes.begin(), std::uint8_t(number));
    writeAll(path, bytes);
  }
  const std::array<std::pair<QByteArray, char>, 5> others{
      {{mgh(), 7}, {gzipped(mgh()), 8}, {gipl(), 9}, {vtk(), 10}, {mrc(), 11}}};
  for (const auto& [bytes, number] : others)
    writeText(folder + "/other" + std::to_string(number), number + bytes.toStdString());
}

// The first byte says what fuzz_archive.cpp reads, and in which pieces.
void webAnswers(const std::string& folder) {
  writeText(folder + "/parts", "\x07--b\r\nContent-Length: 4\r\n\r\na\r\nb\r\n--b\r\n\r\n\r\n--b--\r\n");
  writeText(folder + "/quoted",
            "\x04multipart/related; type=\"application/dicom\"; boundary=\"0123456789abcdef\"\r\n");
  writeText(folder + "/page", R"(0[{"0020000D": {"vr": "UI", "Value": ["1.2"]}, "00100010": {"vr": "PN",
 "Value": [{"Alphabetic": "a^b", "Ideographic": "c"}]}, "00201208": {"Value": [12.5, "3", null]}}])");
}

}  // namespace

int main(int argc, char** argv) {
  const QCoreApplication app(argc, argv);
  if (argc != 2) return 2;
  const std::string root = argv[1];
  for (const char* name : {"dicom", "codec", "answer", "archive", "image_file", "scene", "session"})
    std::filesystem::create_directories(root + "/" + name);
  dicomFiles(root + "/dicom");
  codedFrames(root + "/dicom", root + "/codec");
  answers(root + "/dicom", root + "/answer");
  webAnswers(root + "/archive");
  imageFiles(root + "/image_file");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string name = "/seed" + std::to_string(seed);
    writeText(root + "/scene" + name, sceneToJson(randomScene(seed).scene));
    if (const Result<std::string> session = sessionToJson(randomWorkspace(seed), "/"))
      writeText(root + "/session" + name, *session);
  }
}

// Writes the seeds of the fuzz drivers: make_seeds FOLDER.
#include <QCoreApplication>
#include <array>
#include <filesystem>

#include "io/files/write_volume.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/io/dicom_writer.h"
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

// The first byte is the place of the ending in fuzz_image_file.cpp.
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
}

}  // namespace

int main(int argc, char** argv) {
  const QCoreApplication app(argc, argv);
  if (argc != 2) return 2;
  const std::string root = argv[1];
  for (const char* name : {"dicom", "codec", "image_file", "scene", "session"})
    std::filesystem::create_directories(root + "/" + name);
  dicomFiles(root + "/dicom");
  imageFiles(root + "/image_file");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string name = "/seed" + std::to_string(seed);
    writeText(root + "/scene" + name, sceneToJson(randomScene(seed).scene));
    if (const Result<std::string> session = sessionToJson(randomWorkspace(seed), "/"))
      writeText(root + "/session" + name, *session);
  }
}

#include "app/picture_output.h"

#include <QImage>

#include "app/report_files.h"
#include "results/pictures/annotate.h"

namespace volumen {

void addPictureOutput(CLI::App& app, std::string& output, const std::string& help) {
  app.add_option("-o,--output", output, help)->type_name("PICTURE");
}

void addNoWarningLine(CLI::App& app, bool& noWarningLine) {
  app.add_flag(
      "--no-warning-line", noWarningLine,
      "Do not write into a corner of the PNG what is not as it seems (interpolated slices, tilt, not "
      "calibrated); its text keeps it");
}

bool isFloatPicture(const std::string& path) { return path.size() > 5 && path.ends_with(".nrrd"); }

Status checkPictureName(const std::string& path) {
  if (isFloatPicture(path) || (path.size() > 4 && path.ends_with(".png"))) return {};
  return Error{path + ": pictures are written as .png (8 bits) or .nrrd (floats)."};
}

void addWarnings(QImage& image, PictureText& text, const std::vector<Warning>& warnings, bool warningLine) {
  const PictureText warned = warningText(warnings);
  text.insert(text.end(), warned.begin(), warned.end());
  if (warned.empty() || !warningLine) return;
  prepareFonts();
  annotate(image, warningOverlays(warnings));
}

Status writePictureWithWarnings(QImage image, PictureText text, const std::vector<Warning>& warnings,
                                bool warningLine, const std::string& path) {
  addWarnings(image, text, warnings, warningLine);
  return writeImage(image, path, text);
}

}  // namespace volumen

#include <csignal>
#include <iostream>

#include "app/command.h"

namespace {

const volumen::CancelToken cancelled;

// A second Ctrl-C ends the program at once, in case the first one is not noticed soon.
void onInterrupt(int signal) {
  cancelled.cancel();
  std::signal(signal, SIG_DFL);
}

struct Entry {
  const char* name;
  const char* text;
  volumen::MakeCommand make;
};

constexpr Entry commands[] = {
    {"accuracy", "What accuracy costs in time: every knob of the renderer measured on one scene",
     volumen::makeAccuracy},
    {"bench", "How fast a scene is drawn from all around", volumen::makeBench},
    {"convert", "Write a series as one file (.nrrd, .nii.gz, .mha) or as DICOM", volumen::makeConvert},
    {"info", "What is in a file or folder: patients, studies, series, geometry, warnings", volumen::makeInfo},
    {"open", "The desktop program", volumen::makeOpen},
    {"render", "Draw a picture without a window", volumen::makeRender},
    {"segment", "Label the voxels of a value range; writes .seg.nrrd", volumen::makeSegment},
};

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  CLI::App app{"volumen, a DICOM workstation for people without a GPU to spare. Not for clinical use."};
  app.name("volumen");
  app.set_version_flag("--version", "volumen " VOLUMEN_VERSION);
  app.require_subcommand(1);
  std::function<int()> run;
  for (const Entry& entry : commands) {
    CLI::App* sub = app.add_subcommand(entry.name, entry.text);
    auto runThis = entry.make(*sub, cancelled);
    sub->callback([runThis, &run] { run = runThis; });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int status = app.exit(e);
    return status == 0 ? volumen::exitDone : volumen::exitUsage;
  }
  return run();
}

#include "app/command_line.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>

#include "app/command.h"
#include "app/list_presets.h"
#include "app/open_volume.h"
#include "app/startable_threads.h"
#include "app/usage.h"
#include "app/version.h"
#include "io/frame_limit.h"
#include "io/paths/open_path.h"
#include "io/worker/worker.h"
#include "viewer/volume/available_memory.h"

namespace volumen {

namespace {

struct Entry {
  const char* name;
  const char* text;
  MakeCommand make;
  bool readsSeries = false;
};

constexpr Entry commands[] = {
    {"open", "Open the window", makeOpen},
    {"render", "Render a picture without a window", makeRender, true},
    {"slice", "Draw a plane through a volume, or a slab", makeSlice, true},
    {"info", "List patients, studies and series, with geometry and warnings", makeInfo, true},
    {"import", "Read studies into the index", makeImport},
    {"list", "List the studies of the index", makeList},
    {"archive", "Search archives beside this machine (PACS), fetch from them, send to them, and receive",
     makeArchive},
    {"forget", "Take studies out of the index; their files stay", makeForget},
    {"convert", "Write a series as .nrrd, .nii.gz, .mha or DICOM", makeConvert, true},
    {"export", "Hand on measurements, segments, pictures and slices, or copies without the identity",
     makeExport},
    {"segment", "Segment by a recipe or a value range, and measure", makeSegment, true},
    {"compare", "Compare the segments of two files", makeCompare},
    {"measure", "Measure lengths, angles, regions, volumes and segments", makeMeasure, true},
    {"batch", "Do a list of work: many series, several programs, each piece once", makeBatch},
    {"accuracy", "Measure what every setting costs in time and accuracy", makeAccuracy, true},
    {"bench", "Measure how fast a scene is drawn from all around", makeBench, true},
};

bool isPath(const std::string& word) {
  std::error_code ignored;
  return word.empty() || isStudyName(word) || word.find_first_of("/.") != std::string::npos ||
         std::filesystem::exists(word, ignored);
}

int statusOf(const std::function<int()>& command) {
  try {
    return command();
  } catch (const std::bad_alloc&) {
    return fail("There was not enough memory (" + memoryText(processMemory().available) +
                " are left); close other programs, or allow more.");
  }
}

// Restarts the workers, as running ones would keep the old limit.
void readFramesUpTo(double megapixels) {
  setFramePixelLimit(std::uint64_t(megapixels * 1e6));
  if (!worker::isolating()) return;
  worker::stop();
  worker::start();
}

std::string nameOfChosen(const CLI::App*& at) {
  std::string name = "volumen ";
  while (!at->get_subcommands().empty()) {
    at = at->get_subcommands().front();
    name += at->get_name() + " ";
  }
  return name;
}

}  // namespace

CommandLine::CommandLine(const CancelToken& cancel)
    : app_(
          "volumen shows CT, MR and other scans in 3D, without a GPU. Not for clinical use.\n"
          "PATH is a file, a folder or phantom:NAME[:SIZE], a volume that the program makes.") {
  app_.name("volumen");
  app_.require_subcommand(0, 1);  // else words of a search would be commands, too
  app_.formatter(std::make_shared<HelpFormatter>());
  app_.set_help_flag("-h,--help", "Show this help; `volumen COMMAND --help` shows that of a command");
  app_.set_version_flag("--version", versionText(), "Show version, revision and CPU target");
  addListPresets(app_);
  addExamples(app_, {"volumen scans/", "volumen render scans/ --preset CT-Bone -o bone.png"});
  app_.footer(
      "Exit status: 0 done; 1 failed; 2 wrong usage; 3 done, but files of the series could not be read.\n\n" +
      app_.get_footer());
  for (const Entry& entry : commands) {
    CLI::App* sub = app_.add_subcommand(entry.name, entry.text);
    sub->group("Commands");
    sub->set_help_flag("-h,--help", "Show this help");
    auto runThis = entry.make(*sub, cancel);
    sub->add_flag_callback("--in-process", worker::stop)->group("");
    number(sub->add_option_function<double>("--largest-frame", readFramesUpTo,
                                            "Read frames of up to so many million pixels (default: 268)"),
           1, 4295);
    if (entry.readsSeries)
      sub->add_flag_callback(
          "--strict", refuseLosses,
          "Write nothing, and end with status 1, where a file of the series cannot be read");
    sub->callback([runThis, this] { chosen_ = runThis; });
  }
}

const CLI::App* CommandLine::command(const std::string& name) const {
  const bool isKnown = std::ranges::any_of(commands, [&](const Entry& entry) { return name == entry.name; });
  return isKnown ? app_.get_subcommand(name) : nullptr;
}

int CommandLine::run(std::vector<std::string> words) {
  if (words.empty() || (!command(words[0]) && isPath(words[0]))) words.insert(words.begin(), "open");
  if (!words[0].starts_with('-') && !command(words[0])) return failUsage(unknownCommand(words[0], app_));
  try {
    std::ranges::reverse(words);
    app_.parse(words);
  } catch (const CLI::Success& e) {
    return app_.exit(e);
  } catch (const CLI::ParseError& e) {
    const CLI::App* at = &app_;
    const std::string name = nameOfChosen(at);
    return failUsage(usageProblem(e, *at) + "\nSee `" + name + "--help`.");
  }
  keepToStartableThreads();
  return statusOf(chosen_);
}

}  // namespace volumen

#include <cstdio>

#include "viewer/paper/paper.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

namespace {

std::string pictureName(const PaperPicture& p) {
  return std::to_string(p.width) + "^2, " +
         (p.samples ? std::to_string(p.samples) : std::string("volume depth"));
}

double paperMs(const PaperBench& bench, const PaperCell& cell) {
  return 1000 * paperSeconds(cell.method, cell.picture, bench.volumes[cell.volume].column);
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// Writes one row per picture and one column per volume: ms, and the speed-up over the paper.
std::string table(const PaperBench& bench, Method method, const char* title) {
  std::string out = std::string("\n## ") + title + "\n\n| picture, samples a ray |";
  std::string line = "|---|";
  for (const PaperVolume& v : bench.volumes) {
    const std::string column = paperVolumeNames[v.column];
    out += " " + (v.column < 3 ? column : v.name + " for the " + column) + " |";
    line += "---|";
  }
  out += "\n" + line + "\n";
  for (int picture = 0; picture < int(paperPictures.size()); ++picture) {
    out += "| " + pictureName(paperPictures[picture]) + " |";
    for (const PaperCell& cell : bench.cells)
      if (cell.method == method && cell.picture == picture)
        out += formatted(" %.2f (%.0f x) |", cell.medianMs, paperMs(bench, cell) / cell.medianMs);
    out += "\n";
  }
  return out;
}

double oneThreadMs(const PaperBench& bench, int volume) {
  for (const PaperThreads& t : bench.threads)
    if (t.volume == volume && t.threads == 1) return t.medianMs;
  return 0;
}

std::string threadsTable(const PaperBench& bench) {
  std::string out =
      "\n## Figure 9: threads (128^2 pixels, 84 samples a ray)\n\n| volume | threads | ms | speed-up |\n"
      "|---|---|---|---|\n";
  for (const PaperThreads& t : bench.threads)
    out += formatted("| %s | %d | %.2f | %.2f |\n", bench.volumes[t.volume].name.c_str(), t.threads,
                     t.medianMs, oneThreadMs(bench, t.volume) / t.medianMs);
  return out;
}

std::string rivalsTable(const PaperBench& bench) {
  std::string out =
      "\n## Section 4: the methods the paper compares itself with (" + bench.rivalsOn +
      ")\n\nErrors in 1/255, 99th percentile and PSNR: of the picture that a method means to draw, and of "
      "the lit, translucent one.\n\n| method | what | ms | own picture | lit picture |\n"
      "|---|---|---|---|---|\n";
  for (const PaperRival& r : bench.rivals)
    out += formatted("| %s | %s | %.1f | %.2f, %.1f dB | %.2f, %.1f dB |\n", r.name.c_str(), r.what.c_str(),
                     r.medianMs, r.own.percentile99, r.own.psnrDb, r.against.percentile99, r.against.psnrDb);
  return out +
         "\nLacroute's shear-warp (VolPack), where installed, is timed by the benchmark `bench_volpack` on "
         "the same "
         "orbit as ours; it draws in one colour, so that its errors would say nothing.\n";
}

}  // namespace

std::string paperText(const PaperBench& bench, const std::string& machine, const std::string& date) {
  std::string out =
      "# The paper's measurements on this machine\n\n" + machine + ", " + bench.kernel + ", " + date +
      ". Median ms a frame, and how many times as fast that is as the paper's figure (one processor "
      "of an SGI Onyx2, InfiniteReality graphics, 1998). The three phantoms are the paper's; the "
      "other volumes stand in for its scans at their own size, so their ratios compare different "
      "volumes.\n";
  out += table(bench, Method::planes, "Table 1: Planes");
  out += table(bench, Method::blend, "Table 2: Blend (what is hidden is left out)");
  out += threadsTable(bench);
  out +=
      "\n## Independence of the volume's size (opaque sphere, 100^2 pixels, 100 samples; the paper: 130 ms "
      "each)\n\n| edge | ms |\n|---|---|\n";
  for (const PaperSize& s : bench.sizes) out += formatted("| %d | %.2f |\n", s.edge, s.medianMs);
  return out + rivalsTable(bench);
}

std::string paperTablesCsv(const PaperBench& bench) {
  std::string out = "method,width,samples,volume,paperVolume,medianMs,minimumMs,paperSeconds,speedUp\n";
  for (const PaperCell& c : bench.cells) {
    const PaperPicture& p = paperPictures[c.picture];
    const PaperVolume& v = bench.volumes[c.volume];
    out += formatted("%s,%d,%s,\"%s\",%s,%.4f,%.4f,%.2f,%.1f\n", methodName(c.method), p.width,
                     p.samples ? std::to_string(p.samples).c_str() : "depth", v.name.c_str(),
                     paperVolumeNames[v.column], c.medianMs, c.minimumMs, paperMs(bench, c) / 1000,
                     paperMs(bench, c) / c.medianMs);
  }
  return out;
}

std::string paperThreadsCsv(const PaperBench& bench) {
  std::string out = "volume,threads,medianMs,speedUp\n";
  for (const PaperThreads& t : bench.threads)
    out += formatted("\"%s\",%d,%.4f,%.4f\n", bench.volumes[t.volume].name.c_str(), t.threads, t.medianMs,
                     oneThreadMs(bench, t.volume) / t.medianMs);
  return out;
}

std::string paperRivalsCsv(const PaperBench& bench) {
  std::string out = "method,what,medianMs,ownMax,ownP99,ownRmse,litMax,litP99,litRmse\n";
  for (const PaperRival& r : bench.rivals)
    out += formatted("%s,\"%s\",%.4f,%.3f,%.3f,%.4f,%.3f,%.3f,%.4f\n", r.name.c_str(), r.what.c_str(),
                     r.medianMs, r.own.maximum, r.own.percentile99, r.own.rmse, r.against.maximum,
                     r.against.percentile99, r.against.rmse);
  return out;
}

}  // namespace volumen

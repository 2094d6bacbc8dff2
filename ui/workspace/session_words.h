#pragma once

#include "ui/workspace/session_fields.h"
#include "ui/workspace/workspace.h"

// The words for enumerators in session files.
namespace volumen {

inline const Words<FrameWindow> frameWindowWords{
    {"usual", FrameWindow::usual}, {"ofSeries", FrameWindow::ofSeries}, {"ofEach", FrameWindow::ofEach}};
inline const Words<SlabMode> slabWords{
    {"max", SlabMode::max}, {"min", SlabMode::min}, {"mean", SlabMode::mean}};
inline const Words<DerivedKind> regionWords{{"contours", DerivedKind::contours},
                                            {"segmentation", DerivedKind::segmentation}};
inline const Words<DerivedKind> derivedWords{{"presentation", DerivedKind::presentation},
                                             {"contours", DerivedKind::contours},
                                             {"segmentation", DerivedKind::segmentation}};
inline const Words<CurvedKind> curvedWords{{"straightened", CurvedKind::straightened},
                                           {"stretched", CurvedKind::stretched}};
inline const Words<TissueShown::Where> tissueWords{{"everywhere", TissueShown::Where::everywhere},
                                                   {"inside", TissueShown::Where::inside},
                                                   {"outside", TissueShown::Where::outside}};
inline const Words<SegmentAlgorithm> algorithmWords{{"unsaid", SegmentAlgorithm::unsaid},
                                                    {"manual", SegmentAlgorithm::manual},
                                                    {"semiautomatic", SegmentAlgorithm::semiautomatic},
                                                    {"automatic", SegmentAlgorithm::automatic}};
inline const Words<Aim> aimWords{{"level", Aim::level}, {"time", Aim::time}, {"error", Aim::error}};

inline Words<ViewKind> namedKinds() {
  Words<ViewKind> words;
  for (const KindRow& row : viewKinds()) words.emplace_back(row.word, row.kind);
  return words;
}

inline Words<Layout> namedLayouts() {
  Words<Layout> words;
  for (const Layout layout : allLayouts()) words.emplace_back(layoutName(layout), layout);
  return words;
}

inline Words<Layout> namedGrids() {
  Words<Layout> words = namedLayouts();
  std::erase_if(words, [](const auto& word) { return !comparesSeries(word.second); });
  return words;
}

inline Words<Quality> namedQualities() {
  Words<Quality> words;
  for (const Quality q : {Quality::draft, Quality::standard, Quality::high, Quality::exact})
    words.emplace_back(qualityName(q), q);
  return words;
}

inline Words<ColourMap> namedColourMaps() {
  Words<ColourMap> words;
  for (const ColourMap map : colourMaps()) words.emplace_back(colourMapName(map), map);
  return words;
}

inline const Words<ColourMap> colourWords = namedColourMaps();
inline const Words<ViewKind> kindWords = namedKinds();
inline const Words<Layout> layoutWords = namedLayouts();
inline const Words<Layout> gridWords = namedGrids();
inline const Words<Quality> qualityWords = namedQualities();

}  // namespace volumen

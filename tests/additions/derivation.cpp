// An addition: a value derived from the series in focus, its number of voxels above 0, and a feature that
// shows it.
#include <QLabel>

#include "ui/document/derivation.h"
#include "ui/features/feature.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

struct BrightKey {
  LoadedSeriesPtr series;
  bool operator==(const BrightKey&) const = default;
};

using BrightVoxels = Derivation<BrightKey, std::size_t>;

BrightVoxels::Rule brightVoxelsRule(const Session& session) {
  return {.wanted =
              [&session] {
                const LoadedSeriesPtr series = session.seriesOf(session.workspace().focus);
                return series ? std::vector{BrightKey{series}} : std::vector<BrightKey>();
              },
          .work = [](const BrightKey& key, std::size_t) -> BrightVoxels::Work {
            return [key](const Job&) -> Result<BrightVoxels::ValuePtr> {
              const auto isBright = [](auto value) { return value > 0; };
              return std::visit(
                  [&](const auto& values) -> Result<BrightVoxels::ValuePtr> {
                    return std::make_shared<const std::size_t>(std::ranges::count_if(values, isBright));
                  },
                  key.series->volume->stored());
            };
          },
          .name = [](const BrightKey&) { return JobName(); },
          .bytes = [](std::size_t) { return sizeof(std::size_t); },
          .lacksMemory = outOfMemory};
}

class Brightness : public Feature {
 public:
  explicit Brightness(Workbench& bench)
      : Feature(bench), bright_(brightVoxelsRule(session_), session_, &bench_.document.jobs) {
    auto* label = plainLabel();
    label->setObjectName(QStringLiteral("brightness"));
    bench_.addAboveViews(label);
    connect(&bright_, &BrightVoxels::changed, label, [this, label] {
      const auto& all = bright_.entries();
      label->setText(all.empty() ? QString() : QString::number(*all.front().value));
    });
  }

 private:
  BrightVoxels bright_;
};

}  // namespace

std::unique_ptr<Feature> makeBrightness(Workbench& bench) { return std::make_unique<Brightness>(bench); }

}  // namespace volumen

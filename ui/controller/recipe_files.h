#pragma once

#include "ui/document/job_lane.h"
#include "viewer/recipe/recipe.h"

namespace volumen {

/// Reads and writes recipes; each a job.
class RecipeFiles : public QObject {
  Q_OBJECT
 public:
  explicit RecipeFiles(Jobs& jobs, QObject* parent = nullptr);
  /// Waits for what is being written.
  ~RecipeFiles() override;

  void open(const QString& path);
  void save(const QString& path, const Recipe& recipe);

 Q_SIGNALS:
  void opened(const volumen::Recipe& recipe);
  void saved(const QString& path);
  /// A sentence that names the file.
  void failed(const QString& sentence);

 private:
  JobLane open_, save_;
};

}  // namespace volumen

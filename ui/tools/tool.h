#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "ui/tools/drag.h"
#include "ui/workspace/segment_cut.h"
#include "ui/workspace/segment_stroke.h"
#include "ui/workspace/session.h"
#include "viewer/measure/shape.h"
#include "viewer/segment/mask.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// A place that was clicked to take the connected part there.
struct PartClick {
  SeriesKey series;
  glm::dvec3 pPatient;     ///< mm
  bool onSurface = false;  ///< of a surface seen in 3D, which lies between voxels
  Qt::KeyboardModifiers keys{};
  bool onFrame = false;  ///< a picture that is no slice of a volume
};

/// A ball that is drawn about a place of a slice.
struct DrawnBall {
  enum class State { drawing, done, givenUp };
  SeriesKey series;
  glm::dvec3 pPatient;  ///< its middle, mm
  double radiusMm = 0;
  State state = State::drawing;
  bool onFrame = false;  ///< of a picture that is no slice of a volume
};

/// A view of slices or frames when the mouse was pressed, as far as tools know it.
struct SlicePress {
  Session& session;
  ViewId view;
  LoadedSeriesPtr series;
  SlicePlane plane;                   ///< in device pixels
  double pixelRatio;                  ///< device pixels a logical one
  QPointF at;                         ///< logical pixels
  Window window{};                    ///< in use
  std::optional<ShapeFrame> frame{};  ///< of frames: which; shapes are drawn on it
  Qt::KeyboardModifiers keys{};
  /// Takes the connected part of a place; none where it is no press of the mouse.
  std::function<void(const PartClick& click)> takePart{};
  /// Paints a part of a stroke into the current segment; none where it is no press of the mouse.
  std::function<void(const SegmentStroke& stroke)> paint{};
  /// Hears of a ball as it is drawn; none likewise.
  std::function<void(const DrawnBall& ball)> takeBall{};
  /// Cuts the current segment; none likewise.
  std::function<void(const SegmentCut& cut)> cutSegment{};

  glm::dvec3 patientAt(QPointF p) const {
    return plane.patientFromPixel({p.x() * pixelRatio, p.y() * pixelRatio});
  }
  QPointF pixelAt(glm::dvec3 pPatient) const {
    const glm::dvec2 p = plane.pixelFromPatient(pPatient) / pixelRatio;
    return {p.x, p.y};
  }
  /// Where shapes have a point: in the patient, or in pixels of the frame.
  glm::dvec3 shapePointAt(QPointF p) const {
    if (!frame) return patientAt(p);
    const glm::dvec3 pixel = series->volume->geometry().voxelFromPatient(patientAt(p));
    return {pixel.x, pixel.y, 0};
  }
};

/// A place of a surface that is seen in 3D.
struct SurfacePoint {
  glm::dvec3 pPatient;  ///< mm
  double softMm;        ///< Shape::softMm
};

/// A 3D view when the mouse was pressed, as far as tools know it.
struct ScenePress {
  Session& session;
  ViewId view;
  LoadedSeriesPtr series;
  Scene scene;  ///< its camera is the one in use
  QPointF at;   ///< logical pixels, as are
  glm::dvec2 size;
  Qt::KeyboardModifiers keys;
  std::optional<glm::dvec3> seen;  ///< patient mm: what is seen there; none: nothing
  /// Makes this the camera of the view; steps of one name in a gesture are one.
  std::function<void(const QString& text, const Camera& camera)> moveCamera;
  /// Takes away what was drawn around.
  std::function<void(const Lasso& lasso)> cut;
  /// The surface that is seen at a place of the view, whatever moved its camera since; none: nothing, or a
  /// projection.
  std::function<std::optional<SurfacePoint>(QPointF p)> surfaceAt{};
  /// Says that nothing is seen there that could be measured on.
  std::function<void(QPointF p)> missed{};
  /// Takes the connected part of a place.
  std::function<void(const PartClick& click)> takePart{};
  /// Cuts the current segment.
  std::function<void(const SegmentCut& cut)> cutSegment{};

  const Camera& camera() const { return *scene.camera; }
  /// What turns and moves go about.
  glm::dvec3 pivot() const { return seen.value_or(*camera().target); }
};

/// What a drag does: in slices and frames, in 3D, or in both.
struct Tool {
  const char* name;
  QString text;
  Qt::CursorShape cursor;
  /// Null: nothing there. A drag that is null: the press was all of it.
  std::unique_ptr<Drag> (*inSlices)(const SlicePress& press) = nullptr;
  std::unique_ptr<SceneDrag> (*inScene)(const ScenePress& press) = nullptr;  ///< the same
  int key = 0;             ///< chooses it in a view in which it does something; 0: none
  bool measuring = false;  ///< draws a measurement; its icon is "measure-NAME"
  bool stays = false;      ///< of what is drawn: in hand after one, until Esc
  bool looking = false;    ///< changes nothing, whatever lies under the press
  bool box = false;     ///< a box or an outline is drawn, of which something is made that is no measurement
  bool clicks = false;  ///< each press acts on what is there, however soon it follows; in hand until Esc
  void (*paintAt)(QPainter& painter,
                  const SlicePress& pointer) = nullptr;   ///< drawn in slices at the pointer
  bool (*takesKey)(Session& session, int key) = nullptr;  ///< a key in slices; whether it is taken

  /// Whether it has the left button in all views where it does something, after which, or after Esc, the
  /// tool before is in hand again.
  bool draws() const { return measuring || box || clicks; }
};

/// A part of a measurement under the pointer.
enum class MeasurementPart { handle, line, text };
struct MeasurementHit {
  int id = 0;
  MeasurementPart part = MeasurementPart::line;
  std::size_t handle = 0;    ///< which of handlesOf()
  glm::dvec3 textOffset{0};  ///< of where its text stands now (Measurement::textOffset)
  bool movable = true;       ///< false: the plane only cuts it
};

/// All of them; each is a file of this folder, those that measure are one.
const std::vector<Tool>& tools();
/// The tool of this name; there must be one.
const Tool& toolNamed(std::string_view name);
/// The tool of a key in slices; null: it is none's.
const Tool* sliceToolOfKey(int key);
/// Those of 3D that have a key and draw nothing: they are chosen for the left button.
std::vector<const Tool*> chosenSceneTools();

std::unique_ptr<SceneDrag> beginRotate(const ScenePress& press);
std::unique_ptr<SceneDrag> beginCurve(const ScenePress& press);
std::unique_ptr<SceneDrag> beginScissors(const ScenePress& press);
/// Draws around something; `done` hears of it at its end, Ctrl then meaning all else.
std::unique_ptr<SceneDrag> drawLasso(const ScenePress& press, std::function<void(const Lasso& lasso)> done);
/// Draws a measurement on what is seen; null, and missed(), where nothing is.
std::unique_ptr<SceneDrag> beginSurfaceShape(const ScenePress& press, ShapeKind kind);
/// Moves a point of a measurement, seen there, over what is seen; a way shorter than a drag's moves nothing.
std::unique_ptr<SceneDrag> beginSurfacePoint(const ScenePress& press, int measurement, std::size_t point,
                                             QPointF seenAt);
std::unique_ptr<SceneDrag> beginScenePan(const ScenePress& press);
std::unique_ptr<SceneDrag> beginSceneZoom(const ScenePress& press);
std::unique_ptr<Drag> beginWindow(const SlicePress& press);
std::unique_ptr<Drag> beginSlicePan(const SlicePress& press);
std::unique_ptr<Drag> beginSliceZoom(const SlicePress& press);
std::unique_ptr<Drag> beginScroll(const SlicePress& press);
std::unique_ptr<Drag> beginRegionWindow(const SlicePress& press);
/// Takes the connected part of a voxel, or of the surface that is seen.
std::unique_ptr<Drag> beginPart(const SlicePress& press);
std::unique_ptr<SceneDrag> beginScenePart(const ScenePress& press);
/// A press as tools that change segments have it: where the panel Segments is about the series that lies over
/// the one shown, of that series and with the plane in its space.
SlicePress ofPainted(SlicePress press);
/// Paints the current segment by a brush, or erases: a disc in the slice, or a ball.
std::unique_ptr<Drag> beginPaint(const SlicePress& press);
/// The same, but only what is joined to the pointer and alike to what was under the brush as it was pressed.
std::unique_ptr<Drag> beginSmartBrush(const SlicePress& press);
/// Draws the brush, as large as it is in the patient.
void paintBrushAt(QPainter& painter, const SlicePress& pointer);
/// + and - change the brush by 20 %.
bool resizeBrush(Session& session, int key);
/// Paints or erases what is drawn around.
std::unique_ptr<Drag> beginOutline(const SlicePress& press);
/// Draws an outline by one drag, or point by point; `done` hears of its points once it is closed.
std::unique_ptr<Drag> drawOutline(const SlicePress& press,
                                  std::function<void(const std::vector<glm::dvec3>& points)> done);
/// Takes from the current segment what is drawn around, or all else: through all of it, or as deep as is
/// chosen.
std::unique_ptr<Drag> beginSegmentScissors(const SlicePress& press);
/// The same along the lines of sight, through all of it.
std::unique_ptr<SceneDrag> beginSceneSegmentScissors(const ScenePress& press);
/// Draws a ball about the place that was pressed, in which a lesion is looked for.
std::unique_ptr<Drag> beginLesion(const SlicePress& press);
/// Paints or erases what the closed line at the value that was pressed goes around.
std::unique_ptr<Drag> beginLevelTrace(const SlicePress& press);
/// Draws the line that a press would take.
void paintLevelTrace(QPainter& painter, const SlicePress& pointer);
std::unique_ptr<Drag> beginCrosshair(const SlicePress& press);
std::unique_ptr<Drag> beginMagnifier(const SlicePress& press);
/// Of Enlarged::factor.
inline constexpr double leastEnlarged = 1.5, mostEnlarged = 8;

/// Turns the other planes about the crosshair as the pointer goes around it.
std::unique_ptr<Drag> beginTurn(const SlicePress& press);
/// Moves a plane across its line; `across`: a unit vector, logical pixels.
std::unique_ptr<Drag> beginMovePlane(const SlicePress& press, QPointF across);
/// Those that draw a measurement, one a kind that is drawn.
std::vector<Tool> measuringTools();
/// Moves the part of a measurement that was pressed.
std::unique_ptr<Drag> beginMeasurementEdit(const SlicePress& press, const MeasurementHit& hit);

/// Paints where a slice cuts a ball about a place of its patient space, mm, and the radius of the ball.
void paintBall(QPainter& painter, const SlicePlane& plane, double pixelRatio, glm::dvec3 pMiddle,
               double radiusMm);

/// How much faster than the pointer a window follows it: Shift: fine, Ctrl: fast.
double windowDragSpeed(Qt::KeyboardModifiers keys);
/// How the view shows its series.
FlatLook lookOf(const SlicePress& press);
/// Changes how a flat view shows its series; steps of one name in a gesture are one.
void editFlat(Session& session, ViewId view, const QString& text,
              const std::function<void(FlatLook&)>& change);
/// Shows another frame of a view that shows frames; as many as there are.
void showFrame(Session& session, ViewId view, int frame);
/// Moves the crosshair of a view's series, and turns it.
void setCrosshair(Session& session, ViewId view, const LoadedSeries& series, const QString& text,
                  const Crosshair& after);
/// Moves it alone.
void moveCrosshair(Session& session, ViewId view, const LoadedSeries& series, const QString& text,
                   glm::dvec3 pPatient);
/// Enlarges a flat view about a point, which stays where it is. `plane` shows `from`.
void zoomFlat(Session& session, ViewId view, const FlatLook& from, const SlicePlane& plane, glm::dvec3 fixed,
              double factor);

}  // namespace volumen

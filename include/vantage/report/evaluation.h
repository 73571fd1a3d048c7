// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vantage/report/comparison.h"

/// \file
/// Measures against recorded people: the views they chose, and where they looked.

namespace vantage {

/// A view that somebody chose.
struct ChosenByPerson {
  Vec3 direction = Vec3::UnitZ();  ///< Unit, from the model's centre to the eye.
  bool moved = true;  ///< False where the view is the one that the person was first shown.
};

/// A model with what people did with it.
struct RecordedModel {
  std::string name{};  ///< Of the file; of a manifest its path there. One model has it.
  std::string path{};  ///< To read it from.
  std::vector<ChosenByPerson> views{};  ///< Empty if none were recorded.
  std::vector<MirrorPlane> planes{};    ///< As recorded with the views; normals only matter.
  std::vector<double> gaze{};           ///< Seconds a vertex, or empty.
  std::optional<UpAxis> up{};           ///< If the data set says it.
};

/// Reads a data set: a JSON manifest (docs/evidence.md), or a folder with views.csv (model,subject,status,vx,vy,vz) and models/, optionally
/// mirror_planes.csv (model,nx,ny,nz); or one with gaze/NAME.vertex (a number a line) and
/// meshes/NAME.*; or a folder of both kinds of folder. Models without their file are left out.
/// \throw IoError, FormatError; InvalidInput if there is nothing of the kind.
std::vector<RecordedModel> read_records(const std::string& folder);

/// How near a method, or a fixed camera, comes to the views people chose of one model.
struct ViewAgreement {
  std::string method{};
  std::string model{};
  double mean_deg = 0.0;         ///< Mean angle to the views of people who moved; NaN if none did.
  double mean_folded_deg = 0.0;  ///< The same to the nearest mirror image of each.
  double all_folded_deg = 0.0;   ///< The same of all people, those who kept the start included.
  double within_45 = 0.0;        ///< Share of views nearer than 45°, folded.
  double percentile = 0.0;       ///< Mean rank of people's views in the method's own scores, in
                                 ///< [0, 1]; NaN for cameras.
};

/// How a map agrees with where people looked on one model.
struct GazeAgreement {
  std::string map{};
  std::string model{};
  double correlation = 0.0;      ///< Pearson's.
  double rank = 0.0;             ///< Spearman's.
  double area = 0.0;             ///< Under the ROC curve for the twentieth of most gaze.
  double chance_adjusted = 0.0;  ///< s_f − s_r: mean where people looked less mean of the surface.
  double normalised = 0.0;       ///< (s_f − s_r) / s_r
  double z_score = 0.0;          ///< (s_f − s_r) / σ_r
};

/// Agreement with views of one model: reference cameras first, then the measures, each alone and, of
/// the directions of the set, under the upright prior. \throw Cancelled
std::vector<ViewAgreement> evaluate_views(const RecordedModel& record, const Model& model,
                                          const ViewOptions& options,
                                          const std::vector<Measure>& measures,
                                          const RunContext& run = {});

/// Agreement with gaze of one model: height and curvature first, then the maps. \throw Cancelled
/// \throw InvalidInput if there is not one value of gaze a vertex.
std::vector<GazeAgreement> evaluate_gaze(const RecordedModel& record, const Model& model,
                                         const ViewOptions& options, const RunContext& run = {});

/// What was found out about one record.
struct EvaluatedModel {
  UpAxis up = UpAxis::Y;               ///< That reference cameras stand upright to.
  std::vector<ViewAgreement> views{};  ///< Empty if no views were recorded.
  std::vector<GazeAgreement> gaze{};   ///< Empty if no gaze was recorded.
};

/// Where a run puts down what it has, so that the next one goes on from there: one line of JSON a
/// record, under a key of all that its rows depend on, so that rows for other data or options may stand
/// beside them.
class EvaluationJournal {
 public:
  /// Nothing is kept. \see the other one
  EvaluationJournal();
  /// \param file may exist; what a killed run left half written in it is dropped. \throw IoError
  explicit EvaluationJournal(std::string file);
  ~EvaluationJournal();
  EvaluationJournal(const EvaluationJournal&) = delete;
  EvaluationJournal& operator=(const EvaluationJournal&) = delete;

  /// What an earlier run found out, or nothing.
  [[nodiscard]] const EvaluatedModel* find(const std::string& key) const;
  /// Puts down a record's rows; they are on the disk when it returns. Any thread. \throw IoError
  void add(const std::string& key, const EvaluatedModel& rows);

 private:
  struct State;
  std::unique_ptr<State> state_{};
};

/// Evaluates records side by side, the largest first; rows are in the order of the records whatever the
/// number of threads. Reads the models. Last of a model's rows of views is the best constant camera,
/// fitted on the other models. \param known told how many of the records the journal had.
/// \throw IoError, FormatError, InvalidInput, Cancelled
std::vector<EvaluatedModel> evaluate_records(const std::vector<RecordedModel>& records,
                                             const ViewOptions& options,
                                             const std::vector<Measure>& measures,
                                             EvaluationJournal& journal, std::size_t& known,
                                             const RunContext& run = {});

/// A mean over models with the interval that holds 95 % of bootstrap means.
struct Interval {
  double mean = 0.0, low = 0.0, high = 0.0;
};

/// 2000 seeded resamples of the values that are finite; NaN if there are none.
Interval bootstrap_mean(std::span<const double> values, std::uint64_t seed = 0);

/// The tables as Markdown, intervals included. Either list may be empty.
std::string evidence_tables(const std::vector<ViewAgreement>& views,
                            const std::vector<GazeAgreement>& gaze);

/// One row a method and model, with a header.
std::string view_agreement_csv(const std::vector<ViewAgreement>& rows);
std::string gaze_agreement_csv(const std::vector<GazeAgreement>& rows);  ///< The same.

}  // namespace vantage

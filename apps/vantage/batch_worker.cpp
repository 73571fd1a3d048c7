// SPDX-License-Identifier: MIT
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/sidecar.h"
#include "vantage/report/view_report.h"

#include "batch/archive_reader.h"
#include "batch/content_hash.h"
#include "batch/file_stamp.h"
#include "batch/file_watch.h"
#include "batch/json_text.h"
#include "batch/naming.h"
#include "batch/thumbnail.h"
#include "commands.h"
#include "import_program.h"
#include "input_text.h"
#include "load_posed.h"
#include "look_flags.h"
#include "method_flags.h"
#include "output_folder.h"
#include "view_outputs.h"
#include "view_set_flags.h"

/// \file
/// The worker of a batch: `vantage batch-worker`, started by `vantage batch` and by nobody else.
/// Each line on standard input is a model; it answers with the content's hash, is told "go" or
/// "skip", and answers with the result or the reason why there is none. One model's failure leaves
/// it fit for the next; what cannot be caught ends the process, which its parent replaces.

namespace vantage::cli {
namespace {

using batch::Json;

void say(int answers, const Json& json) {
  if (!batch::write_json_line(answers, json)) {
    throw IoError("batch", "does not listen any more", errno);
  }
}

/// For tests only: VANTAGE_TEST_FAULT="crash:part,hang:part,memory:part,nonsense:part" makes the worker go
/// wrong on models whose key contains `part`.
void inject_test_fault(const std::string& key, int answers) {
  const char* faults = std::getenv("VANTAGE_TEST_FAULT");
  std::string_view rest = faults == nullptr ? "" : faults;
  while (!rest.empty()) {
    const std::string_view fault = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), fault.size() + 1));
    const std::size_t colon = std::min(fault.find(':'), fault.size() - 1);
    if (fault.size() <= colon + 1 || key.find(fault.substr(colon + 1)) == std::string::npos) {
      continue;
    }
    if (fault.starts_with("crash")) {
      std::abort();
    }
    if (fault.starts_with("nonsense")) {
      say(answers, {{"result", 5}});
    }
    while (fault.starts_with("hang")) {
      ::sleep(1);
    }
    for (std::vector<std::string> allocated; fault.starts_with("memory");) {
      allocated.emplace_back(std::size_t{64} << 20U, 'x');
    }
  }
}

/// Peak of resident memory since the last call, bytes.
std::int64_t peak_bytes() {
  std::ifstream status("/proc/self/status");
  std::int64_t peak = 0;
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) {
      peak = std::atoll(line.c_str() + 6) * 1024;
    }
  }
  std::ofstream("/proc/self/clear_refs") << "5";  // starts the next peak from here
  return peak;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; !what.empty() && (at = text.find(what, at)) != std::string::npos;) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
  return text;
}

/// Names the pictures of imported models, for which the importer has to read them; of exact solids none. What
/// it sent is kept for the model's reader.
class ImportedOnce {
 public:
  ImportedOnce(std::string path, ModelImporter importer, const RunContext& run)
      : path_(std::move(path)), importer_(std::move(importer)), run_(run) {}

  std::vector<std::string> pictures(const ImportFormat& format) {
    if (!pictures_) {
      pictures_.emplace();
      try {
        if (!format.solid) {
          stream_ = importer_({format, read_text(path_), path_}, run_);
          *pictures_ = pictures_beside(stream_);
        }
      } catch (const FormatError&) {  // the model's reader will say so
      } catch (const IoError&) {
      }
    }
    return *pictures_;
  }

  /// For the model's reader. \pre This outlives it.
  ModelImporter importer() {
    return [this](const ImportRequest& request, const RunContext& run) {
      return stream_.empty() ? importer_(request, run) : std::exchange(stream_, {});
    };
  }

 private:
  std::string path_;
  ModelImporter importer_;
  const RunContext& run_;
  std::string stream_{};
  std::optional<std::vector<std::string>> pictures_{};
};

/// Why a file could not be read or written.
const char* reason_of(int error_number, bool reading) {
  const bool full = error_number == ENOSPC || error_number == EDQUOT;
  return full                     ? "disk"
         : error_number == EFBIG  ? "output"
         : error_number == ENOMEM ? "memory"
         : reading                ? "input"
                                  : "work";
}

/// What went wrong in words that are the same wherever, and by whichever worker, a model is done.
std::string told(const Json& order, const std::string& error) {
  const auto label = order.at("label").get<std::string>();
  const std::string staging = batch::path_of_key(order.at("staging").get<std::string>());
  const std::string said = replaced(replaced(error, staging + "/", label + ": "),
                                    batch::path_of_key(order.at("path").get<std::string>()), label);
  const std::string name = order.at("name").get<std::string>() + ": ";  // as results call it
  return said.starts_with(name) ? label + ": " + said.substr(name.size()) : said;
}

/// What to say of a model in an archive that names files beside it; empty of others.
std::string archive_remark(const Json& order, const batch::Content& content) {
  if (!order.at("in_archive").get<bool>() || content.beside.empty()) {
    return "";
  }
  return "files beside models in archives, as " + content.beside.front().name +
         ", are not read; unpack the archive";
}

struct BatchWorkerCommand {
  std::string write{};
  MethodFlags method{};
  ViewSetFlags several{};
  LookFlags look{};

  void add_flags(CLI::App& app, Session& session) {
    app.group("");  // not for people
    app.add_option("--write", write);
    method.add_to(app,
                  {.map = true, .camera = true, .search = true, .picture = true, .fits = true});
    several.add_set_to(app);
    look.add_to_several(app);
    add_common_flags(app, session.flags);
    add_face_limit_flag(app, session.flags.limits);
  }

  void run(Session& session) {
    kinds_ = OutputKinds::parse(write);
    options_ = view_options_of(method, several, look, kinds_, session.flags.seed);
#if defined(M_ARENA_MAX)
    // glibc reserves 64 MB of address space for every thread's heap, which counts as memory here.
    ::mallopt(M_ARENA_MAX, 1);
#endif
    // Whatever a library prints must not be taken for an answer.
    const int answers = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    session.flags.quiet = true;
    for (std::string line; std::getline(std::cin, line);) {
      const Json answer = answer_to(batch::parsed_json(line), session, answers);
      if (!answer.is_null()) {
        say(answers, answer);
      }
    }
  }

 private:
  /// Null if the model is not to be done after all.
  [[nodiscard]] Json answer_to(const Json& order, Session& session, int answers) const {
    const std::string path = batch::path_of_key(order.at("path").get<std::string>());
    const auto key = order.at("key").get<std::string>();
    batch::Content content;
    bool reading = true;
    const auto failed = [&](const char* reason, const std::string& error) {
      return Json{{"reason", reason}, {"error", told(order, error)}, {"peak_bytes", peak_bytes()}};
    };
    const auto unreadable = [&](const std::string& error) {
      const std::string remark = archive_remark(order, content);
      return failed("input", error + (remark.empty() ? "" : "; " + remark));
    };
    try {
      const RunContext reading_run = session.run();
      RunLimits limits = session.flags.limits;
      limits.seconds = order.at("seconds").get<double>();
      ImportedOnce imported(path, model_importer(limits), reading_run);
      const auto pictures = [&](const ImportFormat& format) { return imported.pictures(format); };
      const batch::FileWatch watch(path);
      content = batch::content_of(path, pictures);
      say(answers, {{"content", content.hash}, {"beside", batch::to_json(content.beside)}});
      std::string word;
      if (!std::getline(std::cin, word) || word != "go") {
        return nullptr;
      }
      inject_test_fault(key, answers);
      session.flags.threads = order.at("threads").get<int>();
      const RunContext run = session.run();
      const Sidecar sidecar = sidecar_of(path);
      LookFlags own_look = look;
      own_look.suggest(sidecar.style);
      ReadOptions reading_options;
      if (kinds_.has_pictures()) {
        reading_options = own_look.reading(options_.width, options_.height);
      }
      reading_options.importer = imported.importer();
      reading_options.max_faces = face_limit(session.flags.limits);
      Model model = load_model(path, run, reading_options);
      if (!watch.is_unchanged() || !batch::are_as_they_were(content.beside, path) ||
          batch::content_of(path, pictures).hash != content.hash) {
        return failed("changed", path + ": was changed while it was read; --retry failed");
      }
      if (const std::string remark = archive_remark(order, content); !remark.empty()) {
        model.notes.push_back(remark);
      }
      reading = false;
      model.name = batch::path_of_key(order.at("name").get<std::string>());
      return result_of(order, model, sidecar, own_look, run);
    } catch (const Cancelled&) {
      throw;
    } catch (const IoError& error) {
      const std::string reason = reason_of(error.error_number(), reading);
      const char* const remedy = reason == "output" ? "; --output-limit allows no more" : "";
      return reason == "input" ? unreadable(error.what())
                               : failed(reason.c_str(), error.what() + std::string(remedy));
    } catch (const FormatError& error) {
      return unreadable(error.what());
    } catch (const InvalidInput& error) {
      return failed("input", error.what());
    } catch (const std::bad_alloc&) {
      return failed("memory", "needs more memory than --memory or --max-memory allows");
    } catch (const std::exception& error) {
      return failed("work", error.what());
    }
  }

  [[nodiscard]] Json result_of(const Json& order, Model& model, const Sidecar& sidecar,
                               const LookFlags& own_look, const RunContext& run) const {
    ViewOptions own = options_;
    const auto own_up = order.at("up").get<std::string>();
    if (!own_up.empty()) {
      own.up = up_axis(own_up);
    }
    const auto own_front = order.at("front").get<std::string>();
    if (!own_front.empty()) {
      own.front = up_axis(own_front);
    }
    apply_below(method.flags(), sidecar, own);
    stand_along_axes(model, own);
    const ShapeAnalysis shape = analyse_shape(model, own, run);
    const FrameChoice choice = choose_frame(model, shape, own);
    ViewReport report = find_views(shape, choice, own, run);
    OutputFolder output(batch::path_of_key(order.at("staging").get<std::string>()), kViewResults);
    output.keep_private();  // the parent moves it to its place
    ShapePictures pictures(shape, own_look.of(model, up_vector(choice.frame.up)));
    if (const auto best = add_pictures(output, kinds_, pictures, report, own, run)) {
      output.add(batch::kThumbnailFile, png_bytes(batch::thumbnail_of(*best)));
    }
    if (kinds_.has("views")) {
      several.write(output, shape, pictures, report, choice.frame.up, own, run);
    }
    add_report(output, kinds_, model, shape, pictures, report, own, run);
    add_data(output, kinds_, model, shape, report,
             batch::path_of_key(order.at("file").get<std::string>()));
    const Json view =
        without_missing_images(batch::parsed_json(view_json(model, shape, report, own)));
    output.add("view.json", batch::json_text(view, 2) + "\n");
    Json result;
    for (const char* part : {"format", "vertices", "faces", "components", "closed", "genus"}) {
      result[part] = view["model"][part];
    }
    for (const char* part : {"total", "up", "front", "camera", "best", "worst", "doubts"}) {
      result[part] = view[part];
    }
    result["files"] = output.sizes();
    output.write();
    return {{"result", batch::json_text(result)}, {"peak_bytes", peak_bytes()}};
  }

  /// Pictures that were not asked for are not named either.
  [[nodiscard]] Json without_missing_images(Json view) const {
    for (const char* side : {"best", "worst"}) {
      if (!kinds_.has(side)) {
        view[side]["image"] = nullptr;
      }
    }
    if (!kinds_.has("views") && view.contains("views")) {
      for (Json& one : view["views"]) {
        one["image"] = nullptr;
      }
    }
    return view;
  }

  OutputKinds kinds_{};
  ViewOptions options_{};
};

struct BatchUnpackCommand {
  std::string archive{};
  batch::UnpackLimits limits{};

  void add_flags(CLI::App& app, Session& /*session*/) {
    app.group("");  // not for people
    app.add_option("ARCHIVE", archive)->required();
    app.add_option("BYTES", limits.entry_bytes)->required();
    app.add_option("PASSED", limits.passed)->required();
  }

  void run(Session& /*session*/) const {
    batch::unpack_archive(batch::path_of_key(archive), limits, STDOUT_FILENO);
  }
};

}  // namespace

void add_batch_worker_commands(CLI::App& program, Session& session) {
  add_command<BatchWorkerCommand>(program, session, "batch-worker", "", "");
  add_command<BatchUnpackCommand>(program, session, "batch-unpack", "", "");
}

}  // namespace vantage::cli

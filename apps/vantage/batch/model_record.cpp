// SPDX-License-Identifier: MIT
#include "batch/model_record.h"

#include <tuple>

#include "batch/confined_folder.h"
#include "batch/json_text.h"

namespace vantage::batch {
namespace {

/// Whether brackets nest no deeper than any record of ours: writing JSON is recursive.
bool is_shallow(std::string_view json) {
  constexpr int kDeepest = 32;
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size() && depth <= kDeepest; ++i) {
    const char c = json[i];
    if (in_text) {
      i += c == '\\' ? 1 : 0;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return depth <= kDeepest;
}

}  // namespace

bool is_sound(const ModelRecord& record) {
  const bool placed = record.folder.empty() || ConfinedFolder::is_name(record.folder);
  const bool ended = record.status == "done" || record.status == "failed";
  if (record.key.empty() || !placed || !ended) {
    return false;
  }
  return record.result.empty() ||
         (is_shallow(record.result) && parsed_json(record.result).is_object());
}

bool may_pass_next_time(const std::string& reason) {
  return reason == "crash" || reason == "timeout" || reason == "memory" || reason == "output" ||
         reason == "changed";
}

bool is_of_content(const std::string& reason) {
  return reason != "name" && reason != "changed";
}

bool is_doubted(const ModelRecord& record) {
  // Results are compact JSON, and none of their texts holds a quotation mark.
  return record.result.find("\"doubts\":[\"") != std::string::npos;
}

std::string content_key(const ModelRecord& record) {
  return record.content + ' ' + record.options;
}

bool same_question(const ModelRecord& a, const ModelRecord& b) {
  return a.options == b.options && a.version == b.version && a.name == b.name;
}

bool have_one_answer(const ModelRecord& a, const ModelRecord& b) {
  return a.content == b.content && a.options == b.options && a.version == b.version;
}

Json to_json(const std::vector<StampBeside>& beside) {
  auto json = Json::array();
  for (const auto& [name, stamp] : beside) {
    json.push_back({name, stamp.size_bytes, stamp.modified_ns, stamp.inode});
  }
  return json;
}

std::vector<StampBeside> beside_of(const Json& json) {
  std::vector<StampBeside> beside;
  try {
    for (const auto& file : json) {
      beside.push_back({file.at(0).get<std::string>(),
                        {file.at(1).get<std::int64_t>(), file.at(2).get<std::int64_t>(),
                         file.at(3).get<std::uint64_t>()}});
    }
  } catch (const Json::exception&) {
    return {};
  }
  return beside;
}

Json to_json(const ModelRecord& record) {
  Json json;
  json["key"] = record.key;
  json["position"] = record.position;
  json["stamp"] = {record.stamp.size_bytes, record.stamp.modified_ns, record.stamp.inode};
  if (!record.beside.empty()) {
    json["beside"] = to_json(record.beside);
  }
  json["content"] = record.content;
  json["options"] = record.options;
  json["version"] = record.version;
  json["status"] = record.status;
  json["reason"] = record.reason;
  json["error"] = record.error;
  json["folder"] = record.folder;
  json["duplicate_of"] = record.duplicate_of;
  json["name"] = record.name;
  json["result"] = record.result.empty() ? Json(nullptr) : parsed_json(record.result);
  json["timings"] = {{"seconds", record.timings.seconds},
                     {"peak_bytes", record.timings.peak_bytes},
                     {"attempts", record.timings.attempts},
                     {"finished_ms", record.timings.finished_ms}};
  return json;
}

std::optional<ModelRecord> record_from_line(const std::string& line) {
  const auto json = is_shallow(line) ? parsed_json(line) : nullptr;
  if (!json.is_object()) {
    return std::nullopt;
  }
  ModelRecord record;
  try {
    const auto& stamp = json.at("stamp");
    record.stamp = {stamp.at(0).get<std::int64_t>(), stamp.at(1).get<std::int64_t>(),
                    stamp.at(2).get<std::uint64_t>()};
    record.beside = beside_of(json.value("beside", Json::array()));
    record.position = json.at("position").get<std::int64_t>();
    using Member = std::string ModelRecord::*;
    const std::pair<const char*, Member> texts[] = {
        {"key", &ModelRecord::key},         {"content", &ModelRecord::content},
        {"options", &ModelRecord::options}, {"version", &ModelRecord::version},
        {"status", &ModelRecord::status},   {"reason", &ModelRecord::reason},
        {"error", &ModelRecord::error},     {"folder", &ModelRecord::folder},
        {"name", &ModelRecord::name},       {"duplicate_of", &ModelRecord::duplicate_of}};
    for (const auto& [name, member] : texts) {
      record.*member = json.at(name).get<std::string>();
    }
    if (!json.at("result").is_null()) {
      record.result = json_text(json.at("result"));
    }
    const auto& timings = json.at("timings");
    record.timings = {
        timings.at("seconds").get<double>(), timings.at("peak_bytes").get<std::int64_t>(),
        timings.at("attempts").get<int>(), timings.at("finished_ms").get<std::int64_t>()};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return is_sound(record) ? std::optional(std::move(record)) : std::nullopt;
}

bool supersedes(const ModelRecord& a, const ModelRecord& b) {
  const bool one_answer = have_one_answer(a, b);
  const auto rank = [&](const ModelRecord& r) {
    return std::make_tuple(one_answer && r.status == "done", r.timings.finished_ms,
                           std::cref(r.version), std::cref(r.options), std::cref(r.folder),
                           std::cref(r.result));
  };
  return rank(a) > rank(b);
}

}  // namespace vantage::batch

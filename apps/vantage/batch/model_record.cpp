// SPDX-License-Identifier: MIT
#include "batch/model_record.h"

#include <tuple>

#include <nlohmann/json.hpp>

namespace vantage::batch {

bool may_pass_next_time(const std::string& reason) {
  return reason == "crash" || reason == "timeout" || reason == "memory" || reason == "output";
}

nlohmann::ordered_json to_json(const ModelRecord& record) {
  nlohmann::ordered_json json;
  json["key"] = record.key;
  json["position"] = record.position;
  json["stamp"] = {record.stamp.size_bytes, record.stamp.modified_ns, record.stamp.inode};
  json["content"] = record.content;
  json["options"] = record.options;
  json["version"] = record.version;
  json["status"] = record.status;
  json["reason"] = record.reason;
  json["error"] = record.error;
  json["folder"] = record.folder;
  json["duplicate_of"] = record.duplicate_of;
  json["name"] = record.name;
  json["result"] = record.result.empty() ? nlohmann::ordered_json(nullptr)
                                         : nlohmann::ordered_json::parse(record.result);
  json["timings"] = {{"seconds", record.timings.seconds},
                     {"peak_bytes", record.timings.peak_bytes},
                     {"attempts", record.timings.attempts},
                     {"finished_ms", record.timings.finished_ms}};
  return json;
}

std::optional<ModelRecord> record_from_line(const std::string& line) {
  const auto json = nlohmann::ordered_json::parse(line, nullptr, false);
  if (!json.is_object()) {
    return std::nullopt;
  }
  ModelRecord record;
  try {
    const auto& stamp = json.at("stamp");
    record.stamp = {stamp.at(0).get<std::int64_t>(), stamp.at(1).get<std::int64_t>(),
                    stamp.at(2).get<std::uint64_t>()};
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
      record.result = json.at("result").dump();
    }
    const auto& timings = json.at("timings");
    record.timings = {
        timings.at("seconds").get<double>(), timings.at("peak_bytes").get<std::int64_t>(),
        timings.at("attempts").get<int>(), timings.at("finished_ms").get<std::int64_t>()};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
  return record;
}

bool supersedes(const ModelRecord& a, const ModelRecord& b) {
  const auto rank = [](const ModelRecord& r) {
    return std::make_tuple(r.status == "done", r.timings.finished_ms, std::cref(r.version),
                           std::cref(r.options), std::cref(r.folder), std::cref(r.result));
  };
  return rank(a) > rank(b);
}

}  // namespace vantage::batch

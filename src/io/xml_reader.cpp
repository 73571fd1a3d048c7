// SPDX-License-Identifier: MIT
#include "io/xml_reader.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/appearance.h"

#include "io/number_parsing.h"
#include "mesh/extent.h"

namespace vantage {

std::string_view xml_local(std::string_view whole) {
  return whole.substr(whole.rfind(kXmlBetween) + 1);
}

std::string_view xml_space(std::string_view whole) {
  return whole.substr(0, whole.size() - xml_local(whole).size());
}

std::string_view xml_trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

std::optional<std::string_view> XmlAttributes::text(std::string_view name) const {
  for (const XML_Char** at = list_; *at != nullptr; at += 2) {
    if ((reader_ == nullptr ? xml_local(at[0]) : reader_->own_name(at[0])) == name) {
      return at[1];
    }
  }
  return std::nullopt;
}

std::optional<std::uint32_t> XmlAttributes::index(std::string_view name) const {
  return xml_index(text(name).value_or(""));
}

std::optional<std::uint32_t> xml_index(std::string_view text) {
  const auto value = integer_from(xml_trimmed(text));
  return value && *value >= 0 && *value < std::int64_t{Appearance::kNone}
             ? std::optional(static_cast<std::uint32_t>(*value))
             : std::nullopt;
}

XmlReader::XmlReader(const ModelBuilder& builder, std::string place,
                     std::span<const std::string_view> usual_names, std::size_t& records_left)
    : builder_(builder),
      place_(std::move(place)),
      usual_names_(usual_names),
      records_left_(records_left),
      parser_(XML_ParserCreateNS(nullptr, kXmlBetween)) {
  if (parser_ == nullptr) {
    throw std::bad_alloc();
  }
  XML_SetUserData(parser_.get(), this);
  XML_SetElementHandler(parser_.get(), &on_start, &on_end);
  XML_SetCharacterDataHandler(parser_.get(), &on_text);
  XML_SetStartNamespaceDeclHandler(parser_.get(), &on_namespace);
  XML_SetStartDoctypeDeclHandler(parser_.get(), &on_document_type);
}

void XmlReader::parse(std::string_view piece, bool is_last) {
  const XML_Status status =
      XML_Parse(parser_.get(), piece.data(), static_cast<int>(piece.size()), is_last ? 1 : 0);
  if (failure_) {
    std::rethrow_exception(failure_);
  }
  if (status != XML_STATUS_OK) {
    fail(std::string("is not well-formed XML: ") +
         XML_ErrorString(XML_GetErrorCode(parser_.get())));
  }
  // expat keeps what is not whole yet, and begins it anew with each piece.
  added_ += static_cast<XML_Index>(piece.size());
  if (added_ - XML_GetCurrentByteIndex(parser_.get()) >
      static_cast<XML_Index>(kLongestXmlElement + piece.size())) {
    fail("an element is longer than any of a 3D model");
  }
}

std::string_view XmlReader::own_name(std::string_view whole) const {
  const std::string_view space = xml_space(whole);
  return space.empty() || space == root_space_ || reads(space) ? xml_local(whole) : "";
}

/// expat is C: what is thrown inside its calls is kept and thrown again outside.
template <class Step>
void XmlReader::guarded(const Step& step) {
  if (failure_) {
    return;
  }
  try {
    step();
  } catch (...) {
    failure_ = std::current_exception();
    XML_StopParser(parser_.get(), XML_FALSE);
  }
}

void XmlReader::on_start(void* reader, const XML_Char* name, const XML_Char** attributes) {
  auto& self = *static_cast<XmlReader*>(reader);
  self.guarded([&] {
    self.count_name(name);
    for (const XML_Char** at = attributes; *at != nullptr; at += 2) {
      self.count_name(at[0]);
    }
    if (++self.depth_ > kDeepestXmlElement) {
      self.fail("its elements are nested deeper than any of a 3D model");
    }
    if (self.depth_ == 1) {
      self.root_space_ = xml_space(name);
    }
    self.start_element(self.own_name(name), XmlAttributes(attributes, &self));
  });
}

void XmlReader::on_end(void* reader, const XML_Char* name) {
  auto& self = *static_cast<XmlReader*>(reader);
  self.guarded([&] {
    --self.depth_;
    self.end_element(self.own_name(name));
  });
}

void XmlReader::on_text(void* reader, const XML_Char* text, int size) {
  auto& self = *static_cast<XmlReader*>(reader);
  self.guarded([&] { self.add_text({text, static_cast<std::size_t>(size)}); });
}

void XmlReader::on_namespace(void* reader, const XML_Char* prefix, const XML_Char* uri) {
  auto& self = *static_cast<XmlReader*>(reader);
  self.guarded([&] {
    for (const XML_Char* name : {prefix, uri}) {
      self.count_name(name == nullptr ? "" : name);
    }
    if (prefix != nullptr && uri != nullptr && self.depth_ == 0) {
      self.name_space(prefix, uri);
    }
  });
}

void XmlReader::on_document_type(void* reader, const XML_Char* /*name*/, const XML_Char* /*system*/,
                                 const XML_Char* /*publisher*/, int /*has_subset*/) {
  auto& self = *static_cast<XmlReader*>(reader);
  self.guarded(
      [&] { self.fail("has a document type, which no 3D model needs; remove <!DOCTYPE …>"); });
}

void XmlReader::fail(const std::string& problem) const {
  throw FormatError(builder_.name(),
                    place_ + "line " + std::to_string(XML_GetCurrentLineNumber(parser_.get())),
                    problem);
}

void XmlReader::spend() {
  if (records_left_ == 0) {
    fail("more objects, items and colours than the size of the file allows");
  }
  --records_left_;
}

double XmlReader::coordinate(std::string_view text, bool& needs_double) const {
  const std::string_view token = xml_trimmed(text);
  const std::optional<double> value = number_from(token);
  if (!value || !(std::abs(*value) <= kLargestCoordinate)) {
    fail(value ? "a coordinate is not finite, or beyond 1e60" : number_problem(token));
  }
  needs_double = needs_double || vantage::needs_double(token, *value);
  return *value;
}

/// expat keeps all that it meets.
void XmlReader::count_name(std::string_view name) {
  const bool is_usual =
      std::find(usual_names_.begin(), usual_names_.end(), xml_local(name)) != usual_names_.end();
  if (!is_usual && names_.emplace(name).second && names_.size() > kMostXmlNames) {
    fail("has more kinds of elements and attributes than any 3D model");
  }
}

}  // namespace vantage

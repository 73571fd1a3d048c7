// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>

#include <expat.h>

#include "io/model_builder.h"

/// \file
/// XML of strangers: what the parser keeps is bounded, and nothing in it is ever fetched or expanded.

namespace vantage {

/// Names of elements, attributes and namespaces that are not the usual ones; each is kept. [ours]
inline constexpr std::size_t kMostXmlNames = 10'000;
/// Elements may be nested this deep: formats need eight levels. [ours]
inline constexpr int kDeepestXmlElement = 64;
/// Bytes that an element with its attributes, or a comment, may have: names are the longest. [ours]
inline constexpr std::size_t kLongestXmlElement = 1'000'000;

/// Between the namespace of an element and its name.
inline constexpr XML_Char kXmlBetween = '|';

/// The name without its namespace.
std::string_view xml_local(std::string_view whole);

/// The namespace with kXmlBetween behind it; empty: none.
std::string_view xml_space(std::string_view whole);

class XmlReader;

/// Attributes of an element, as expat hands them over.
class XmlAttributes {
 public:
  /// \param reader that knows which namespaces are read; null: any.
  explicit XmlAttributes(const XML_Char** list, const XmlReader* reader = nullptr)
      : list_(list), reader_(reader) {}

  [[nodiscard]] std::optional<std::string_view> text(std::string_view name) const;

  /// A number from 0 to 2³² − 2.
  [[nodiscard]] std::optional<std::uint32_t> index(std::string_view name) const;

 private:
  const XML_Char** list_;
  const XmlReader* reader_;
};

/// Without blanks and ends of lines around it.
std::string_view xml_trimmed(std::string_view text);

/// A number from 0 to 2³² − 2, blanks around it.
std::optional<std::uint32_t> xml_index(std::string_view text);

struct FreeXmlParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

using XmlParser = std::unique_ptr<XML_ParserStruct, FreeXmlParser>;

/// Reads XML piece by piece. A document type, and with it every entity, is refused.
class XmlReader {
 public:
  /// \param place in front of the line in messages, such as "part 3d/a.model, ". \param usual_names what files
  /// hold in thousands. \param records_left things that may still be kept; counts down. All must outlive this.
  XmlReader(const ModelBuilder& builder, std::string place,
            std::span<const std::string_view> usual_names, std::size_t& records_left);
  virtual ~XmlReader() = default;
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;

  /// \throw FormatError
  void add(std::string_view piece) { parse(piece, false); }

  /// Call once all pieces are there. \throw FormatError
  void end() { parse({}, true); }

  /// The name without its namespace; empty if that is neither the root's nor one that is read.
  [[nodiscard]] std::string_view own_name(std::string_view whole) const;

 protected:
  /// \param name see own_name().
  virtual void start_element(std::string_view name, const XmlAttributes& attributes) = 0;
  virtual void end_element(std::string_view name) = 0;

  /// Whether names of another namespace than the root's are the format's, too. \param space see xml_space().
  [[nodiscard]] virtual bool reads(std::string_view /*space*/) const { return false; }

  /// Of an element, maybe in several pieces.
  virtual void add_text(std::string_view /*text*/) {}

  /// A namespace of the root.
  virtual void name_space(std::string_view /*prefix*/, std::string_view /*uri*/) {}

  [[noreturn]] void fail(const std::string& problem) const;

  /// Takes room for something that is kept.
  void spend();

  /// The number in `text`, which may be a coordinate. \param needs_double set where a float does not hold it.
  double coordinate(std::string_view text, bool& needs_double) const;

 private:
  static void on_start(void* reader, const XML_Char* name, const XML_Char** attributes);
  static void on_end(void* reader, const XML_Char* name);
  static void on_text(void* reader, const XML_Char* text, int size);
  static void on_namespace(void* reader, const XML_Char* prefix, const XML_Char* uri);
  static void on_document_type(void* reader, const XML_Char* name, const XML_Char* system,
                               const XML_Char* publisher, int has_subset);

  template <class Step>
  void guarded(const Step& step);
  void parse(std::string_view piece, bool is_last);
  void count_name(std::string_view name);

  const ModelBuilder& builder_;
  const std::string place_;
  std::span<const std::string_view> usual_names_;
  std::size_t& records_left_;
  XmlParser parser_;
  XML_Index added_ = 0;       ///< Bytes.
  std::string root_space_{};  ///< Of the root's name.
  int depth_ = 0;
  std::unordered_set<std::string> names_{};  ///< But for the usual ones.
  std::exception_ptr failure_{};
};

}  // namespace vantage

// SPDX-License-Identifier: MIT
#include <cmath>
#include <istream>
#include <map>
#include <stdexcept>
#include <streambuf>
#include <string>

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <RWMesh_FaceIterator.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XCAFPrs_DocumentExplorer.hxx>

#include "readers.h"

namespace vantage::importing {
namespace {

/// Farthest that a triangle may be from the surface, of the diagonal of the model's box. [ours]
constexpr double kLinearTolerance = 0.001;
/// Largest angle between neighbouring normals, in radians: 20 degrees. [ours]
constexpr double kAngularTolerance = 20.0 * 3.14159265358979323846 / 180.0;
/// Surfaces are bounded by their poles at first; where the triangles turn out to fill less than this of
/// that box, they are made anew by their own. [ours]
constexpr double kTightEnough = 0.9;
constexpr double kMillimetre = 0.001;
constexpr std::uint32_t kZ = 2;

/// Bytes as a stream, without a copy.
class BytesBuffer : public std::streambuf {
 public:
  explicit BytesBuffer(std::string_view bytes) {
    // Streams want to write, and this one is only read.
    char* const first = const_cast<char*>(bytes.data());  // NOLINT(*-const-cast)
    setg(first, first, first + bytes.size());
  }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                   std::ios_base::openmode /*mode*/) override {
    const off_type base = from == std::ios_base::beg   ? 0
                          : from == std::ios_base::cur ? gptr() - eback()
                                                       : egptr() - eback();
    const off_type wanted = base + offset;
    if (wanted < 0 || wanted > egptr() - eback()) {
      return pos_type(off_type(-1));
    }
    setg(eback(), eback() + wanted, egptr());
    return pos_type(wanted);
  }

  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }
};

using Document = opencascade::handle<TDocStd_Document>;
using ShapeTool = opencascade::handle<XCAFDoc_ShapeTool>;

void check(bool good, const char* problem) {
  if (!good) {
    throw std::runtime_error(problem);
  }
}

void load_step(std::string_view bytes, Document& document) {
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  BytesBuffer buffer(bytes);
  std::istream stream(&buffer);
  check(reader.ChangeReader().ReadStream("model", stream) == IFSelect_RetDone, "it is damaged");
  check(reader.Transfer(document), "it holds no shape that can be built");
}

void load_iges(int descriptor, Document& document) {
  IGESCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  // This reader takes names only; the descriptor has one.
  const std::string name = "/proc/self/fd/" + std::to_string(descriptor);
  check(reader.ReadFile(name.c_str()) == IFSelect_RetDone, "it is damaged");
  check(reader.Transfer(document), "it holds no shape that can be built");
}

void load_brep(std::string_view bytes, const Document& document) {
  TopoDS_Shape shape;
  BytesBuffer buffer(bytes);
  std::istream stream(&buffer);
  BRepTools::Read(shape, stream, BRep_Builder());
  check(!shape.IsNull(), "it is damaged");
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->AddShape(shape, /*makeAssembly=*/false);
}

double diagonal_of(const TopoDS_Shape& shape, bool of_triangles) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, of_triangles);
  if (box.IsVoid() || box.IsOpen()) {
    return 0.0;
  }
  return std::sqrt(box.SquareExtent());
}

/// Tessellates all shapes by one tolerance.
void tessellate(const TDF_LabelSequence& roots) {
  TopoDS_Compound all;
  BRep_Builder().MakeCompound(all);
  for (const TDF_Label& root : roots) {
    if (const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(root); !shape.IsNull()) {
      BRep_Builder().Add(all, shape);
    }
  }
  const auto mesh = [&](double diagonal) {
    BRepMesh_IncrementalMesh(all, kLinearTolerance * diagonal, /*isRelative=*/false,
                             kAngularTolerance, /*isInParallel=*/false);
  };
  const double bound = diagonal_of(all, /*of_triangles=*/false);
  check(std::isfinite(bound) && bound > 0.0, "it holds no surface of finite size");
  mesh(bound);
  const double filled = diagonal_of(all, /*of_triangles=*/true);
  if (filled > 0.0 && filled < kTightEnough * bound) {
    BRepTools::Clean(all);
    mesh(filled);
  }
}

std::string name_of(const TDF_Label& label) {
  opencascade::handle<TDataStd_Name> name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) {
    return {};
  }
  std::string text(static_cast<std::size_t>(name->Get().LengthOfCString()) + 1, '\0');
  char* place = text.data();
  name->Get().ToUTF8CString(place);
  text.resize(text.find('\0'));
  return text;
}

/// Sends one placed part after the other.
class PartSender {
 public:
  explicit PartSender(StreamWriter& out) : out_(out) {}

  void send(const XCAFPrs_DocumentNode& node) {
    const std::string name = part_name(node);
    bool same_part = false;
    RWMesh_FaceIterator face(node.RefLabel, node.Location, /*toMapColors=*/true, node.Style);
    while (face.More()) {
      // Faces of one colour in a row make one mesh.
      StreamMesh mesh{.name = name, .material = material_of(face), .same_part = same_part};
      for (; face.More() && material_of(face) == mesh.material; face.Next()) {
        add_face(face, mesh);
      }
      out_.mesh(mesh);
      same_part = true;
    }
  }

 private:
  /// The product's name; of one that stands there several times with its number.
  std::string part_name(const XCAFPrs_DocumentNode& node) {
    std::string name = name_of(node.RefLabel);
    name = name.empty() ? name_of(node.Label) : name;
    const int number = ++uses_[name];
    return number == 1 || name.empty() ? name : name + " (" + std::to_string(number) + ")";
  }

  std::uint32_t material_of(const RWMesh_FaceIterator& face) {
    if (!face.HasFaceColor()) {
      return kImportNone;
    }
    const Quantity_ColorRGBA colour = face.FaceColor();
    const Quantity_Color& rgb = colour.GetRGB();  // linear
    const std::array<double, 4> key{rgb.Red(), rgb.Green(), rgb.Blue(),
                                    static_cast<double>(colour.Alpha())};
    const auto [known, is_new] =
        materials_.try_emplace(key, static_cast<std::uint32_t>(materials_.size()));
    if (is_new) {
      out_.material({.colour = key});
    }
    return known->second;
  }

  static void add_face(const RWMesh_FaceIterator& face, StreamMesh& mesh) {
    if (face.IsEmptyMesh()) {
      return;
    }
    const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    for (int n = face.NodeLower(); n <= face.NodeUpper(); ++n) {
      const gp_Pnt p = face.NodeTransformed(n);
      mesh.positions.insert(mesh.positions.end(), {p.X(), p.Y(), p.Z()});
    }
    const auto vertex = [&](int node) {
      return first + static_cast<std::uint32_t>(node - face.NodeLower());
    };
    for (int t = face.ElemLower(); t <= face.ElemUpper(); ++t) {
      const Poly_Triangle triangle = face.TriangleOriented(t);
      mesh.add_triangle(vertex(triangle(1)), vertex(triangle(2)), vertex(triangle(3)));
    }
  }

  StreamWriter& out_;
  std::map<std::string, int> uses_{};
  std::map<std::array<double, 4>, std::uint32_t> materials_{};
};

void send_document(const Document& document, StreamWriter& out) {
  const ShapeTool shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  TDF_LabelSequence roots;
  shapes->GetFreeShapes(roots);
  check(!roots.IsEmpty(), "it holds no shape that can be built");
  tessellate(roots);
  out.head({.unit_m = kMillimetre, .up = kZ, .double_precision = true});
  PartSender sender(out);
  for (XCAFPrs_DocumentExplorer explorer(document, roots,
                                         XCAFPrs_DocumentExplorerFlags_OnlyLeafNodes);
       explorer.More(); explorer.Next()) {
    sender.send(explorer.Current());
  }
}

}  // namespace

void read_solid(std::string_view format, int descriptor, std::string_view bytes,
                StreamWriter& out) {
  Message::DefaultMessenger()->ChangePrinters().Clear();  // they print to standard output
  try {
    Document document = new TDocStd_Document("MDTV-XCAF");
    if (format == "step") {
      load_step(bytes, document);
    } else if (format == "iges") {
      load_iges(descriptor, document);
    } else {
      load_brep(bytes, document);
    }
    send_document(document, out);
  } catch (const Standard_Failure& failure) {
    throw std::runtime_error(std::string("Open CASCADE gave up (") + failure.DynamicType()->Name() +
                             ")");
  }
}

std::string solid_library() {
  return std::string("Open CASCADE ") + OCC_VERSION_COMPLETE;
}

}  // namespace vantage::importing

#include "shared/vtk_file.hpp"

#include <cassert>
#include <cstdint>
#include <numeric>

#include "core/words.hpp"
#include "shared/file_bytes.hpp"

namespace rill::apps {
namespace {

/// The arrays of a file: described in its XML, and behind it as bytes, each after its length.
class VtkArrays {
 public:
  template <class T>
  std::string add(const char* type, const char* name, int components, const std::vector<T>& values) {
    const std::string element = std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                                std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(size_) + "\"/>\n";
    const uint64_t bytes = values.size() * sizeof(T);
    data_.value(bytes);
    data_.values(values);
    size_ += sizeof bytes + bytes;
    return element;
  }

  /// `grid`: its kind; `piece`: the attributes and elements of its piece.
  std::vector<std::byte> file(const std::string& grid, double time_s, const std::string& piece) {
    std::string head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + grid +
                       "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + grid + ">\n";
    const std::string time = add("Float64", "TimeValue", 1, std::vector<double>{time_s});
    std::string tuple = time;
    tuple.insert(tuple.find(" NumberOfComponents"), " NumberOfTuples=\"1\"");
    head += "<FieldData>\n" + tuple + "</FieldData>\n" + piece + "</" + grid + ">\n<AppendedData encoding=\"raw\">\n_";
    FileBytes all;
    all.text(head);
    all.values(data_.take());
    all.text("\n</AppendedData>\n</VTKFile>\n");
    return all.take();
  }

 private:
  FileBytes data_;
  uint64_t size_ = 0;
};

std::vector<int64_t> counting(size_t count, int64_t step) {
  std::vector<int64_t> all(count);
  for (size_t k = 0; k < count; ++k) all[k] = step * (int64_t(k) + 1);
  return all;
}

/// Particles, each a point and a cell of it. `attributes`: the arrays of the points, which come first.
std::vector<std::byte> pointsFile(VtkArrays& arrays, const std::vector<Float3>& positions, const std::string& attributes, double time_s) {
  const size_t count = positions.size();
  const std::string number = std::to_string(count);
  std::vector<int64_t> points(count);
  std::iota(points.begin(), points.end(), int64_t{0});
  std::string piece = "<Piece NumberOfPoints=\"" + number + "\" NumberOfCells=\"" + number + "\">\n" + attributes;
  piece += "<Points>\n" + arrays.add("Float32", "Points", 3, positions) + "</Points>\n";
  piece += "<Cells>\n" + arrays.add("Int64", "connectivity", 1, points) + arrays.add("Int64", "offsets", 1, counting(count, 1)) +
           arrays.add("UInt8", "types", 1, std::vector<uint8_t>(count, 1)) + "</Cells>\n</Piece>\n";
  return arrays.file("UnstructuredGrid", time_s, piece);
}

}  // namespace

std::vector<std::byte> encodeVtp(const offline::SurfaceTriangles& mesh, double time_s) {
  VtkArrays arrays;
  const size_t triangles = mesh.indices.size() / 3;
  std::string piece = "<Piece NumberOfPoints=\"" + std::to_string(mesh.positions.size()) +
                      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(triangles) +
                      "\">\n";
  piece += "<PointData Normals=\"Normals\" Vectors=\"velocity\">\n" + arrays.add("Float32", "Normals", 3, mesh.normals) +
           arrays.add("Float32", "velocity", 3, mesh.velocities) + "</PointData>\n";
  piece += "<Points>\n" + arrays.add("Float32", "Points", 3, mesh.positions) + "</Points>\n";
  piece += "<Polys>\n" + arrays.add("Int64", "connectivity", 1, std::vector<int64_t>(mesh.indices.begin(), mesh.indices.end())) +
           arrays.add("Int64", "offsets", 1, counting(triangles, 3)) + "</Polys>\n</Piece>\n";
  return arrays.file("PolyData", time_s, piece);
}

std::vector<std::byte> encodeVtu(const offline::Particles& particles, double time_s) {
  VtkArrays arrays;
  assert(particles.velocities.size() == particles.positions.size() && particles.densities.size() == particles.positions.size() &&
         particles.ids.size() == particles.positions.size());
  std::string attributes = "<PointData Scalars=\"density\" Vectors=\"velocity\">\n" +
                           arrays.add("Float32", "velocity", 3, particles.velocities) +
                           arrays.add("Float32", "density", 1, particles.densities) + arrays.add("UInt32", "id", 1, particles.ids);
  if (!particles.fluids.empty()) attributes += arrays.add("UInt8", "fluid", 1, particles.fluids);
  for (size_t n = 0; n < particles.concentrations.size(); ++n)
    attributes += arrays.add("Float32", ("concentration" + std::to_string(particles.diffusing[n])).c_str(), 1, particles.concentrations[n]);
  return pointsFile(arrays, particles.positions, attributes + "</PointData>\n", time_s);
}

std::vector<std::byte> encodeWhitewaterVtu(const offline::DiffuseParticles& particles, double time_s) {
  VtkArrays arrays;
  assert(particles.velocities.size() == particles.positions.size() && particles.ages.size() == particles.positions.size() &&
         particles.classes.size() == particles.positions.size() && particles.randoms.size() == particles.positions.size());
  std::vector<uint8_t> classes;
  for (const WhitewaterClass one : particles.classes) classes.push_back(static_cast<uint8_t>(one));
  const std::string attributes = "<PointData Scalars=\"class\" Vectors=\"velocity\">\n" +
                                 arrays.add("Float32", "velocity", 3, particles.velocities) +
                                 arrays.add("Float32", "age", 1, particles.ages) + arrays.add("UInt32", "random", 1, particles.randoms) +
                                 arrays.add("UInt8", "class", 1, classes);
  return pointsFile(arrays, particles.positions, attributes + "</PointData>\n", time_s);
}

std::string encodePvd(std::span<const std::pair<double, std::string>> files) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto& [time_s, file] : files)
    text += "<DataSet timestep=\"" + shortestNumber(time_s) + "\" part=\"0\" file=\"" + file + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace rill::apps

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shakebed::fitting::networks {

using Point = std::array<double, 3>;
using Index = std::uint32_t;  ///< of a grain or of a contact within one snapshot

/// A contact between two grains, i < j. Force and lengths are in the units of the file it came
/// from; shakebed's own files use d = m = g = 1.
struct Contact {
  Index i;
  Index j;
  double normal_force;  ///< > 0 pushes; the few that pull while they separate are < 0
};

/// One instant of a bed: where the grains are and which of them press on each other.
/// Positions are taken as they stand: there are no periodic images.
struct Snapshot {
  std::string name;
  std::vector<std::int64_t> id;  ///< ascending, so that the order of rows in a file is forgotten
  std::vector<Point> position;   ///< of the centres
  std::vector<double> radius;
  std::vector<Contact> contacts;          ///< grain-grain, by (i, j); zero forces included
  std::size_t wall_contacts = 0;          ///< with a base, lid or side wall; in no network
  std::size_t contacts_not_touching = 0;  ///< grains further apart than rounding explains

  std::size_t grains() const { return position.size(); }
};

/// Distance between the centres of a contact's grains.
double length(const Snapshot& snapshot, const Contact& contact);
double distance(const Point& a, const Point& b);

/// The median diameter: of the small grains when one is large. Bins of F(r) are in this unit.
double median_diameter(const Snapshot& snapshot);

/// A grain larger than 1.5 median radii: Sun's intruder (3.16 d0), not a spread of +-10 %.
bool is_large(const Snapshot& snapshot, Index grain, double median_diameter);

struct GrainRow {
  std::int64_t id;
  Point position;
  double radius;
};
struct ContactRow {
  std::int64_t i;
  std::optional<std::int64_t> j;  ///< empty: a wall
  double normal_force;
};
/// Names the place of a row for error messages: "grains.csv:17".
using Place = std::function<std::string(std::size_t row)>;

/// Checks and sorts raw rows into a snapshot. Throws files::Error(bad_input) naming the rows for:
/// no grains, coordinates, radii or forces that are not finite, radii <= 0, a repeated id, two
/// centres at one point, a contact with a missing grain or of a grain with itself, and a contact
/// given twice (either way round). A contact whose grains do not overlap stays, and is counted in
/// `contacts_not_touching` when the gap exceeds the rounding of coordinates given with 6 digits.
Snapshot assemble(std::string name, const std::vector<GrainRow>& grains, const Place& grain_place,
                  const std::vector<ContactRow>& contacts, const Place& contact_place);

/// Reads a pair of CSV files with at least the columns `id,x,y,z,radius` and `i,j,normal_force`
/// (units in brackets after a name are ignored, and so are further columns). Ids are any integers
/// up to 2^53 in size; an empty j means a wall.
Snapshot read_snapshot_csv(const std::filesystem::path& grains,
                           const std::filesystem::path& contacts);

/// Reads `/snapshots/NAME/{id, position, radius}` and `/contacts/NAME/{i, j, normal_force}` of an
/// HDF5 file: id, i and j integers, position n x 3; j = -1 is a wall; further data sets are
/// ignored. `file` may end in ":NAME", and must when the file holds several snapshots.
/// Throws files::Error(bad_input) naming the file and data set.
Snapshot read_snapshot_hdf5(const std::filesystem::path& file);

}  // namespace shakebed::fitting::networks

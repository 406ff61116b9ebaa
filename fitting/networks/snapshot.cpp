#include "fitting/networks/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "files/csv.hpp"
#include "files/error.hpp"

namespace shakebed::fitting::networks {

namespace {

/// Faults are told together, but a file that is wrong throughout need not fill the screen.
constexpr std::size_t most_faults_told = 20;

class Faults {
 public:
  void add(std::string where, std::string what) {
    if (faults_.size() < most_faults_told) faults_.push_back({std::move(where), std::move(what)});
    ++count_;
  }
  void throw_if_any() {
    if (count_ == 0) return;
    if (count_ > faults_.size()) {
      faults_.push_back({"", "and " + std::to_string(count_ - faults_.size()) + " more faults"});
    }
    throw files::Error(files::Error::Kind::bad_input, std::move(faults_));
  }

 private:
  std::vector<files::Fault> faults_;
  std::size_t count_ = 0;
};

std::string grain_text(std::int64_t id) { return "grain " + std::to_string(id); }

/// Beyond this, squares of distances overflow.
constexpr double largest_number = 1e100;

std::string got(double value) {
  return std::isnan(value) ? "none (nan)" : files::number_text(value);
}

void check_numbers(const GrainRow& grain, const std::string& where, Faults& faults) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(grain.position[axis]) <= largest_number) continue;
    faults.add(where, grain_text(grain.id) + ": expected a finite " + "xyz"[axis] + ", got " +
                          got(grain.position[axis]));
  }
  if (!(grain.radius > 0) || grain.radius > largest_number) {
    faults.add(where, grain_text(grain.id) + ": expected a radius > 0, got " + got(grain.radius));
  }
}

std::vector<std::size_t> sorted_rows(std::size_t count, const auto& before) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), before);
  return order;
}

void check_distinct(const std::vector<GrainRow>& grains, const std::vector<std::size_t>& by_id,
                    const Place& place, Faults& faults) {
  for (std::size_t k = 1; k < by_id.size(); ++k) {
    if (grains[by_id[k]].id != grains[by_id[k - 1]].id) continue;
    faults.add(place(by_id[k]), grain_text(grains[by_id[k]].id) + " is also given at " +
                                    place(by_id[k - 1]) + "; ids must be unique");
  }
  const auto by_position = sorted_rows(grains.size(), [&](std::size_t a, std::size_t b) {
    return grains[a].position < grains[b].position;
  });
  for (std::size_t k = 1; k < by_position.size(); ++k) {
    const GrainRow& one = grains[by_position[k - 1]];
    const GrainRow& other = grains[by_position[k]];
    if (one.position != other.position || one.id == other.id) continue;
    faults.add(place(by_position[k]), grain_text(other.id) +
                                          " has its centre at the same point as " +
                                          grain_text(one.id) + " at " + place(by_position[k - 1]));
  }
}

/// Larger than any gap that coordinates printed with 6 significant digits (LAMMPS dumps) can feign:
/// each is off by at most 5e-6 of itself, a distance by 2 sqrt(3) times that.
double rounding(const Snapshot& snapshot, const Contact& contact) {
  double largest = snapshot.radius[contact.i] + snapshot.radius[contact.j];
  for (const Index grain : {contact.i, contact.j}) {
    for (const double x : snapshot.position[grain]) largest = std::max(largest, std::abs(x));
  }
  return 2e-5 * largest;
}

class ContactReader {
 public:
  ContactReader(const Snapshot& snapshot, const Place& place, Faults& faults)
      : place_(place), faults_(faults) {
    index_.reserve(snapshot.id.size());
    for (std::size_t grain = 0; grain < snapshot.id.size(); ++grain) {
      index_.emplace(snapshot.id[grain], static_cast<Index>(grain));
    }
  }

  std::optional<Contact> contact(const ContactRow& row, std::size_t number) const {
    if (!std::isfinite(row.normal_force)) {
      faults_.add(place_(number), "expected a finite normal_force, got " + got(row.normal_force));
    }
    const auto i = grain(row.i, number);
    if (!row.j) return std::nullopt;
    const auto j = grain(*row.j, number);
    if (!i || !j) return std::nullopt;
    if (*i == *j) {
      faults_.add(place_(number), "a contact of " + grain_text(row.i) +
                                      " with itself; leave j empty for a contact with a wall");
      return std::nullopt;
    }
    return Contact{std::min(*i, *j), std::max(*i, *j), row.normal_force};
  }

 private:
  std::optional<Index> grain(std::int64_t id, std::size_t number) const {
    const auto found = index_.find(id);
    if (found != index_.end()) return found->second;
    faults_.add(place_(number),
                "names " + grain_text(id) + ", which the grains' table does not hold");
    return std::nullopt;
  }

  const Place& place_;
  Faults& faults_;
  std::unordered_map<std::int64_t, Index> index_;
};

void take_contacts(Snapshot& snapshot, const std::vector<ContactRow>& rows, const Place& place,
                   Faults& faults) {
  const ContactReader reader(snapshot, place, faults);
  std::vector<std::pair<Contact, std::size_t>> kept;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto contact = reader.contact(rows[row], row);
    if (contact) kept.emplace_back(*contact, row);
    if (!rows[row].j) ++snapshot.wall_contacts;
  }
  std::stable_sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.i, a.first.j) < std::pair(b.first.i, b.first.j);
  });
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const auto& [contact, row] = kept[k];
    if (k > 0 && contact.i == kept[k - 1].first.i && contact.j == kept[k - 1].first.j) {
      faults.add(place(row), "the contact of " + grain_text(snapshot.id[contact.i]) + " with " +
                                 grain_text(snapshot.id[contact.j]) + " is also given at " +
                                 place(kept[k - 1].second) + "; give each pair once");
    }
    snapshot.contacts.push_back(contact);
  }
}

}  // namespace

double distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

double length(const Snapshot& snapshot, const Contact& contact) {
  return distance(snapshot.position[contact.i], snapshot.position[contact.j]);
}

double median_diameter(const Snapshot& snapshot) {
  std::vector<double> radius = snapshot.radius;
  const auto middle = radius.begin() + static_cast<std::ptrdiff_t>(radius.size() / 2);
  std::nth_element(radius.begin(), middle, radius.end());
  return 2 * *middle;
}

bool is_large(const Snapshot& snapshot, Index grain, double median) {
  return snapshot.radius[grain] > 1.5 * median / 2;
}

Snapshot assemble(std::string name, const std::vector<GrainRow>& grains, const Place& grain_place,
                  const std::vector<ContactRow>& contacts, const Place& contact_place) {
  if (grains.empty()) throw files::bad_input(name, "holds no grains; expected at least one row");
  Faults faults;
  for (std::size_t row = 0; row < grains.size(); ++row) {
    check_numbers(grains[row], grain_place(row), faults);
  }
  faults.throw_if_any();

  const auto by_id = sorted_rows(
      grains.size(), [&](std::size_t a, std::size_t b) { return grains[a].id < grains[b].id; });
  check_distinct(grains, by_id, grain_place, faults);
  Snapshot snapshot;
  snapshot.name = std::move(name);
  for (const std::size_t row : by_id) {
    snapshot.id.push_back(grains[row].id);
    snapshot.position.push_back(grains[row].position);
    snapshot.radius.push_back(grains[row].radius);
  }
  take_contacts(snapshot, contacts, contact_place, faults);
  faults.throw_if_any();

  for (const Contact& contact : snapshot.contacts) {
    const double gap =
        length(snapshot, contact) - snapshot.radius[contact.i] - snapshot.radius[contact.j];
    if (gap > rounding(snapshot, contact)) ++snapshot.contacts_not_touching;
  }
  return snapshot;
}

}  // namespace shakebed::fitting::networks

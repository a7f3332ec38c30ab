// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::Frame;
using evidence::Proposition;

std::vector<std::string> names_of(const Frame& frame) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < frame.size(); ++i) names.push_back(frame.name(i));
  return names;
}

// What the constraints of a hybrid model empty, as a list of intersections.
std::vector<std::string> emptied(const Frame& frame) {
  std::vector<std::string> result;
  const Proposition every = Proposition::first(frame.region_count());
  const Proposition missing = every - frame.existing(every);
  if (missing.empty()) return result;
  std::string text = Frame::free_dsm(names_of(frame)).to_string(missing);
  constexpr std::string_view kUnion = " ∪ ";
  for (std::size_t end; (end = text.find(kUnion)) != std::string::npos; text.erase(0, end + kUnion.size())) {
    result.push_back(text.substr(0, end));
  }
  result.push_back(text);
  return result;
}

std::string model_of(const Frame& frame) {
  if (frame.is_power_set()) return "shafer";
  return emptied(frame).empty() ? "free" : "hybrid";
}

Frame frame_of(const std::string& model, std::vector<std::string> names, const std::vector<std::string>& empty) {
  if (model == "shafer") return Frame::shafer(std::move(names));
  return Frame::hybrid(std::move(names), empty);
}

std::string frame_repr(const Frame& frame) {
  const std::string names = py::repr(py::cast(names_of(frame)));
  const std::string model = model_of(frame);
  if (model == "shafer") return "Frame.shafer(" + names + ")";
  if (model == "free") return "Frame.free_dsm(" + names + ")";
  return "Frame.hybrid(" + names + ", empty=" + std::string(py::repr(py::cast(emptied(frame)))) + ")";
}

Proposition from_regions(const Frame& frame, const std::vector<std::size_t>& regions) {
  Proposition set;
  for (const std::size_t region : regions) {
    if (region >= frame.region_count()) {
      throw std::invalid_argument("the frame has " + std::to_string(frame.region_count()) +
                                  " Venn regions, numbered from 0; got " + std::to_string(region));
    }
    set |= Proposition::region(region);
  }
  return set;
}

std::vector<std::size_t> regions_of(const NamedProposition& self) {
  std::vector<std::size_t> regions;
  for (std::size_t i = 0; i < self.frame.region_count(); ++i) {
    if (self.set.contains(i)) regions.push_back(i);
  }
  return regions;
}

py::int_ bits_of(const NamedProposition& self) {
  std::string digits(self.frame.region_count(), '0');
  for (const std::size_t region : regions_of(self)) digits[digits.size() - 1 - region] = '1';
  return py::reinterpret_steal<py::int_>(PyLong_FromString(digits.c_str(), nullptr, 2));
}

NamedProposition with(const NamedProposition& self, const Proposition& set) { return {self.frame, set}; }

// The other proposition, on the frame of the first.
Proposition other_of(const NamedProposition& self, const NamedProposition& other) {
  return resolved(self.frame, SetLike(other));
}

void bind_set_algebra(py::class_<NamedProposition>& proposition) {
  using P = NamedProposition;
  proposition
      .def(
          "__and__", [](const P& a, const P& b) { return with(a, a.set & other_of(a, b)); }, py::is_operator())
      .def(
          "__or__", [](const P& a, const P& b) { return with(a, a.set | other_of(a, b)); }, py::is_operator())
      .def(
          "__sub__", [](const P& a, const P& b) { return with(a, a.frame.admitted(a.set - other_of(a, b))); },
          py::is_operator())
      .def("__invert__", [](const P& a) { return with(a, a.frame.admitted(a.frame.all() - a.set)); })
      .def(
          "__le__", [](const P& a, const P& b) { return a.existing().subset_of(other_of(a, b)); }, py::is_operator())
      .def(
          "__ge__", [](const P& a, const P& b) { return a.frame.existing(other_of(a, b)).subset_of(a.set); },
          py::is_operator())
      .def(py::self == py::self)
      .def("__hash__", [](const P& a) { return a.existing().hash(); })
      .def("__bool__", [](const P& a) { return !a.existing().empty(); })
      .def("__index__", bits_of);
}

void bind_proposition(py::module_& module) {
  using P = NamedProposition;
  py::class_<P> proposition(module, "Proposition", R"(An element of the power set or hyper-power set of a frame.

Made by `frame["A ∪ B"]`. `&` is ∩, `|` is ∪, `-` takes away, `~` is the complement, `<=` says that one implies the
other; it is false if nothing of it exists. Equal, and with equal hashes, are those that are the same in the model.
An index: `dense[proposition]` is its entry in a dense array.

>>> frame = Frame.shafer(["A", "B", "C"])
>>> ~frame["A"] & frame["A ∪ B"]
Proposition('B')
>>> frame["A"] <= frame["A ∪ B"], bool(frame["A"] & frame["B"])
(True, False))");
  bind_set_algebra(proposition);
  proposition.def_readonly("frame", &P::frame, "The frame that it is of.")
      .def_property_readonly("regions", regions_of, "Its Venn regions, growing; on a power set the elements' indices.")
      .def_property_readonly(
          "cardinality", [](const P& self) { return self.frame.cardinality(self.set); },
          "Number of Venn regions that exist in it (DSm cardinality); on a power set of elements.")
      .def(
          "meets", [](const P& self, const P& other) { return self.existing().meets(other_of(self, other)); },
          py::arg("other"), "meets(self, other)\n--\n\nWhether something that exists is in both.")
      .def(
          "composing", [](const P& self) { return with(self, self.frame.composing(self.set)); },
          "composing(self)\n--\n\nThe union of the elements that it is composed of, u(X) of DSmH: A ∩ B gives A ∪ B.")
      .def("__str__", [](const P& self) { return self.frame.to_string(self.set); })
      .def("__repr__",
           [](const P& self) {
             return "Proposition(" + std::string(py::repr(py::str(self.frame.to_string(self.set)))) + ")";
           })
      .def(py::pickle([](const P& self) { return py::make_tuple(self.frame, regions_of(self)); },
                      [](const py::tuple& state) {
                        const auto frame = state[0].cast<Frame>();
                        return P{frame, from_regions(frame, state[1].cast<std::vector<std::size_t>>())};
                      }));
}

void bind_frame_making(py::class_<Frame>& frame) {
  frame
      .def_static("shafer", &Frame::shafer, py::arg("names"), R"(shafer(names)
--

The elements exclude each other: propositions are subsets, 2^Θ. Up to 256 elements.

ValueError for no name, one given twice, too many, or one with the characters of an operator.)")
      .def_static("free_dsm", &Frame::free_dsm, py::arg("names"), R"(free_dsm(names)
--

Any elements may overlap: propositions are built by ∪ and ∩, the hyper-power set D^Θ. Up to 8 elements.)")
      .def_static(
          "hybrid",
          [](std::vector<std::string> names, const std::vector<std::string>& empty) {
            return Frame::hybrid(std::move(names), empty);
          },
          py::arg("names"), py::arg("empty"), R"(hybrid(names, empty)
--

The free model with constraints: every proposition of `empty`, given as text, is empty. Up to 8 elements.

>>> Frame.hybrid(["A", "B", "C"], empty=["A ∩ B"])["(A ∪ C) ∩ B"]
Proposition('B ∩ C')

ValueError also where nothing is left.)");
}

void bind_frame_reading(py::class_<Frame>& frame) {
  frame
      .def(
          "parse",
          [](const Frame& self, const std::string& text) {
            return NamedProposition{self, self.parse(text)};
          },
          py::arg("text"), R"(parse(self, text)
--

The proposition that a text says, as `frame[text]`: elements, ∪ or |, ∩ or & (binds tighter), parentheses, ∅ and Θ;
on a power set also ¬ or ~. ValueError says where and what was expected.)")
      .def("__getitem__",
           [](const Frame& self, const std::string& text) {
             return NamedProposition{self, self.parse(text)};
           })
      .def(
          "from_regions",
          [](const Frame& self, const std::vector<std::size_t>& regions) {
            return NamedProposition{self, self.admitted(from_regions(self, regions))};
          },
          py::arg("regions"), R"(from_regions(self, regions)
--

The proposition of these Venn regions (Proposition.regions); on a power set of the elements with these indices.
ValueError if there is none.)")
      .def(
          "index", [](const Frame& self, const std::string& name) { return self.index(name); }, py::arg("name"),
          "index(self, name)\n--\n\nPosition of an element among the names. ValueError names the elements.")
      .def(
          "propositions",
          [](const Frame& self) {
            std::vector<NamedProposition> result;
            for (const Proposition& set : self.propositions()) result.push_back({self, set});
            return result;
          },
          R"(propositions(self)
--

All but ∅, by growing cardinality: 2^n - 1 on a power set; 4, 18, 166, 7579 for n = 2 .. 5 on the free model.
ValueError beyond 20 elements of a power set and 5 of another.)");
}

}  // namespace

void bind_frames(py::module_& module) {
  py::class_<Frame> frame(module, "Frame", R"(A frame of discernment: named elements, and which of their overlaps exist.

Made by Frame.shafer, Frame.free_dsm or Frame.hybrid; `frame["A ∪ B"]` is a proposition, len(frame) the number of
elements. A value: it never changes, compares by names and model, is hashable and can be pickled.)");
  bind_proposition(module);
  bind_frame_making(frame);
  bind_frame_reading(frame);
  frame.def("__len__", &Frame::size)
      .def_property_readonly("names", names_of, "Names of the elements, in order.")
      .def_property_readonly(
          "elements",
          [](const Frame& self) {
            std::vector<NamedProposition> result;
            for (std::size_t i = 0; i < self.size(); ++i) result.push_back({self, self.element(i)});
            return result;
          },
          "The elements as propositions, in order, each with its overlaps.")
      .def_property_readonly(
          "all",
          [](const Frame& self) {
            return NamedProposition{self, self.all()};
          },
          "Everything that exists, Θ.")
      .def_property_readonly("model", model_of, "\"shafer\", \"free\" or \"hybrid\".")
      .def_property_readonly("empty", emptied, "What the constraints of a hybrid model empty, as texts.")
      .def_property_readonly("is_power_set", &Frame::is_power_set, "Of Shafer's model: elements exclude each other.")
      .def_property_readonly("region_count", &Frame::region_count,
                             "Number of Venn regions, also those that do not exist; n on a power set.")
      .def(py::self == py::self)
      .def("__hash__",
           [](const Frame& self) {
             return py::hash(py::make_tuple(model_of(self), py::tuple(py::cast(names_of(self))), self.region_count()));
           })
      .def("__repr__", frame_repr)
      .def(py::pickle([](const Frame& self) { return py::make_tuple(model_of(self), names_of(self), emptied(self)); },
                      [](const py::tuple& state) {
                        return frame_of(state[0].cast<std::string>(), state[1].cast<std::vector<std::string>>(),
                                        state[2].cast<std::vector<std::string>>());
                      }));
}

}  // namespace credo::python

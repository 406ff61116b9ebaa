#pragma once

#include <string>

/// A manifest with one entry, of which any keys may follow.
inline const std::string manifest_of_one_figure = R"(manifest: 1
papers:
  p: {title: A paper, doi: 10.1000/1}
entries:
  p-fig1:
    paper: p
    item: Fig. 1
    what: something)";

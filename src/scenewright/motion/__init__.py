"""Motion along one axis: profiles of acceleration that is even or changes evenly, and the laws that bound it."""

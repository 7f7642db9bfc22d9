"""Motion along one axis: profiles of acceleration that is even or changes evenly, laws and limits that bound it."""

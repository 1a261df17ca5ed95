"""Sphinx extension: references in alphabetical order, labelled by author and year.

The style is chosen in ``_config.yml`` as ``bibtex_default_style: author_year``.
"""

from pybtex.plugin import register_plugin
from pybtex.style.formatting.plain import Style as PlainStyle
from pybtex.style.labels import BaseLabelStyle
from pybtex.style.sorting import BaseSortingStyle


def names(entry):
    """The authors' last names; institutions, in braces in the file, are names as well."""
    people = entry.persons["author"]
    return [" ".join(map(str, [*p.rich_prelast_names, *p.rich_last_names])) for p in people]


class ByAuthor(BaseSortingStyle):
    """Alphabetical, whatever the authors are."""

    def sorting_key(self, entry):
        """Names without regard to capitals, then the year."""
        return [name.casefold() for name in names(entry)], entry.fields["year"]


class AuthorYear(BaseLabelStyle):
    """Labels like "Gear and Østerby, 1984"."""

    def format_labels(self, sorted_entries):
        """A label for each entry."""
        for entry in sorted_entries:
            *first, last = names(entry)
            if last == "others" or len(first) > 2:
                authors = f"{first[0]} et al."
            else:
                authors = f"{', '.join(first)} and {last}" if first else last
            yield f"{authors}, {entry.fields['year']}"


class Style(PlainStyle):
    """Entries as in the plain style."""

    default_label_style = AuthorYear
    default_sorting_style = ByAuthor


def setup(app):
    """Make the style known."""
    register_plugin("pybtex.style.formatting", "author_year", Style)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

"""The book's approximations of dry friction as producers of motions."""

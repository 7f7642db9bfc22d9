"""Language: text -> story -> program, and program -> story -> plain English, with one typed story in the middle."""

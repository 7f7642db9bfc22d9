"""Stories by language models."""

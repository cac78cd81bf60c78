//! The registry of generators: reads any species file.

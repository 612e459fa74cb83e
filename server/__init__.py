"""What decides: control, jobs, vision, storage, the API and the command line."""

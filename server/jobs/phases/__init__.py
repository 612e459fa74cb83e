"""The phases of a job, one module each; every one is ``async def run(job: JobContext)``."""

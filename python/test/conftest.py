"""Random properties take the same cases in each run, however slow it is."""
from hypothesis import HealthCheck, settings

settings.register_profile(
    "same", derandomize=True, deadline=None,
    suppress_health_check=[HealthCheck.data_too_large, HealthCheck.too_slow])
settings.load_profile("same")

#include "digest.h"

/* A value as four bytes, least significant first. */
static uint64_t put(uint64_t hash, uint32_t value)
{
    unsigned byte;
    for (byte = 0; byte < 4u; byte += 1u) {
        hash = (hash ^ (value & 0xFFu)) * 0x00000100000001B3ull;
        value >>= 8;
    }
    return hash;
}

static uint64_t verdicts(uint64_t hash, const SupervisorDecision *decision)
{
    size_t channel;
    for (channel = 0; channel < SUPERVISOR_CHANNELS; channel += 1) {
        const SupervisorVerdict *verdict = &decision->verdicts[channel];
        hash = put(hash, verdict->kind);
        hash = put(hash, verdict->reason);
        hash = put(hash, (uint32_t)verdict->value);
        hash = put(hash, (uint32_t)verdict->limit);
        hash = put(hash, (uint32_t)verdict->margin);
    }
    return hash;
}

static uint64_t outputs(uint64_t hash, const SupervisorOutputs *out)
{
    hash = put(hash, out->target_speed);
    hash = put(hash, out->brake_total);
    hash = put(hash, out->brake_electric);
    hash = put(hash, (uint32_t)out->steering_angle);
    hash = put(hash, out->steering_rate);
    hash = put(hash, (uint32_t)out->steering_overlay);
    hash = put(hash, out->drive_torque);
    hash = put(hash, out->drive_active);
    hash = put(hash, out->drive_origin);
    hash = put(hash, out->brake_mode);
    hash = put(hash, out->brake_priority);
    hash = put(hash, out->retarder_torque);
    hash = put(hash, out->retarder_mode);
    hash = put(hash, out->retarder_priority);
    hash = put(hash, out->gear);
    hash = put(hash, out->epb_request);
    hash = put(hash, out->epb_mode);
    hash = put(hash, out->steering_enable);
    hash = put(hash, out->steering_weight);
    hash = put(hash, out->steering_bar_limit);
    hash = put(hash, out->k4);
    hash = put(hash, out->k1);
    hash = put(hash, out->air_pump);
    hash = put(hash, out->power_steering);
    hash = put(hash, out->dc_dc);
    hash = put(hash, out->forward_collision);
    hash = put(hash, out->pedestrian);
    hash = put(hash, out->seat_leave);
    hash = put(hash, out->hazard_flashers);
    hash = put(hash, out->fault_lamp);
    hash = put(hash, out->notice_lamp);
    hash = put(hash, out->lane_departure);
    hash = put(hash, out->speed_limit);
    hash = put(hash, out->headway);
    hash = put(hash, out->wipers);
    hash = put(hash, out->brake_lamps);
    hash = put(hash, out->indicator_left);
    hash = put(hash, out->indicator_right);
    hash = put(hash, out->low_beam);
    hash = put(hash, out->high_beam);
    hash = put(hash, out->horn);
    return put(hash, out->mode);
}

static uint64_t status(uint64_t hash, const SupervisorStatus *of)
{
    hash = put(hash, of->parked_for_ms);
    hash = put(hash, of->faults);
    hash = put(hash, of->occupancy);
    hash = put(hash, of->parked_by_leave);
    hash = put(hash, of->stage);
    hash = put(hash, of->level);
    hash = put(hash, of->mode);
    hash = put(hash, of->exit);
    hash = put(hash, of->safe_state);
    return put(hash, of->record);
}

uint64_t digest(const SupervisorDecision *decision, const SupervisorFrame *frames, size_t count)
{
    uint64_t hash = 0xCBF29CE484222325ull;
    size_t at;
    hash = verdicts(hash, decision);
    hash = outputs(hash, &decision->outputs);
    hash = status(hash, &decision->status);
    for (at = 0; at < count; at += 1) {
        const uint8_t *data = frames[at].data;
        hash = put(hash, frames[at].id);
        hash = put(hash, (uint32_t)data[0] | (uint32_t)data[1] << 8 | (uint32_t)data[2] << 16 | (uint32_t)data[3] << 24);
        hash = put(hash, (uint32_t)data[4] | (uint32_t)data[5] << 8 | (uint32_t)data[6] << 16 | (uint32_t)data[7] << 24);
    }
    return hash;
}
